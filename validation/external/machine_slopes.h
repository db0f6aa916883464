#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/fast/effort_derivatives.h"

namespace ursula {

/// What changes of a machine do to its torques to first order, exact to rounding. For one thread.
class MachineSlopes {
 public:
  /// `scenario` outlives it.
  explicit MachineSlopes(const Scenario& scenario);

  using Change = std::function<void(ManipulatorParameters&, double x)>;

  /// The torques' derivatives by x at 0 for these motions, N·m or N. Throws as Solver does.
  std::vector<Vector6d> along(const Change& change, const std::vector<Motion<double>>& motions);

 private:
  /// By each number of the machine, for each motion; kept until other motions are asked for.
  const std::vector<EffortDerivatives::Columns>& byNumbers(const std::vector<Motion<double>>& motions);

  const Scenario& scenario_;
  EffortDerivatives derivatives_;
  std::vector<double> instants_;
  std::vector<EffortDerivatives::Columns> by_numbers_;
};

}  // namespace ursula
