#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "studies/sweep/motion_extremes.h"
#include "studies/sweep/sweep_plan.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What is found of one point of a plan: its row and results. For one thread at a time; holds nothing that another
/// point's answer hangs on.
class SweepWorker {
 public:
  explicit SweepWorker(SweepPlan& plan) : plan_(plan) {}

  /// Whatever is wrong with the point is in its verdict and error; throws nothing of its own.
  SweepPoint at(std::int64_t i);

 private:
  void inverse(std::int64_t i, SweepPoint& point);
  void validate(std::int64_t i, SweepPoint& point);
  ValidationResult pointwise(std::int64_t i);

  SweepPlan& plan_;
  MotionExtremes extremes_;
  std::optional<std::vector<Check>> of_motion_;
};

}  // namespace ursula
