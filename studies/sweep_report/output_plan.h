#pragma once

#include <string>
#include <vector>

#include "studies/sweep_report/sweep_rows.h"
#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// Determines the outputs from the results' names, and their values for a point.
class OutputPlan {
 public:
  OutputPlan(bool validates, const std::vector<std::string>& names);

  /// The outputs without statistics.
  const std::vector<SweepOutput>& outputs() const { return outputs_; }
  /// Computes one number per output, NaN if the point has none.
  void evaluate(const SweepRow& row, std::vector<double>& values) const;
  /// Returns the largest output of the group whose largest value is the first output.
  std::size_t largestOf(const std::vector<double>& values) const;
  /// 1 to 6; 0 if no leg refused the point.
  int refusedLeg(const SweepRow& row) const;

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  std::size_t groupOf(OutputKind kind, const std::string& unit);

  std::vector<SweepOutput> outputs_;
  std::vector<std::size_t> place_,
      group_;  ///< for each name: the index of its output, and of the output with its group's largest value
  std::size_t refused_leg_ = nowhere;  ///< index among the names
};

}  // namespace ursula
