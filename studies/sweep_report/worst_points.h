#pragma once

#include <vector>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// Selects the points to look at first: at most three errors with different texts, then failures, then the largest
/// scores; ties by id.
class WorstPoints {
 public:
  /// Whether add() would keep it.
  bool takes(const WorstPoint& point) const;
  void add(WorstPoint point);
  std::vector<WorstPoint> worst() const;

 private:
  std::vector<WorstPoint> errors_, others_;  ///< the worst first
};

}  // namespace ursula
