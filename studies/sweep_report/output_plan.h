#pragma once

#include <string>
#include <vector>

#include "studies/sweep_report/sweep_rows.h"
#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// Which outputs the results' names make, and their values of a point.
class OutputPlan {
 public:
  OutputPlan(bool validates, const std::vector<std::string>& names);

  /// Without what is found of them.
  const std::vector<SweepOutput>& outputs() const { return outputs_; }
  /// One number for each output, NaN where the point has none.
  void evaluate(const SweepRow& row, std::vector<double>& values) const;
  /// The output, of those that the first one is the largest of, that is largest.
  std::size_t largestOf(const std::vector<double>& values) const;
  /// 1 to 6; 0 where no leg refused.
  int refusedLeg(const SweepRow& row) const;

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  std::size_t groupOf(OutputKind kind, const std::string& unit);

  std::vector<SweepOutput> outputs_;
  std::vector<std::size_t> place_, group_;  ///< of each name: its output, and the output that is its group's largest
  std::size_t refused_leg_ = nowhere;       ///< among the names
};

}  // namespace ursula
