#pragma once

#include <vector>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// The points to look at first: errors, of which no more than three and each with a text of its own, then what failed,
/// then the largest score; equals by their ids.
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
