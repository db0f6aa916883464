#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/scenario.h"
#include "parts/derivatives/effort_derivatives.h"

namespace ursula {

/// First-order effects of changes of a machine on its torques, exact to rounding. For one thread.
class MachineSlopes {
 public:
  /// `scenario` must outlive it.
  explicit MachineSlopes(const Scenario& scenario);

  using Change = std::function<void(ManipulatorParameters&, double x)>;

  /// The torques' derivatives by x at 0 for these motions, N·m or N. Throws like Solver.
  std::vector<Vector6d> along(const Change& change, const std::vector<Motion<double>>& motions);

 private:
  /// Derivatives by each number of the machine, for each motion; cached until the motions change.
  const std::vector<EffortDerivatives::Columns>& byNumbers(const std::vector<Motion<double>>& motions);

  const Scenario& scenario_;
  EffortDerivatives derivatives_;
  std::vector<double> instants_;
  std::vector<EffortDerivatives::Columns> by_numbers_;
};

}  // namespace ursula
