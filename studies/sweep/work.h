#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "studies/sweep/motion_extremes.h"
#include "studies/sweep/sweep_plan.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Computes the row and the results of points of a plan. For one thread at a time; no answer depends on other points.
class SweepWorker {
 public:
  explicit SweepWorker(SweepPlan& plan) : plan_(plan) {}

  /// Throws nothing: the point's verdict and error hold every problem.
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
