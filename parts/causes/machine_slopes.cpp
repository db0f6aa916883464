#include "parts/causes/machine_slopes.h"

#include "model/machine_numbers.h"
#include "validation/subject/subject.h"

namespace ursula {

MachineSlopes::MachineSlopes(const Scenario& scenario) : scenario_(scenario), derivatives_(*scenario.manipulator) {}

std::vector<Vector6d> MachineSlopes::along(const Change& change, const std::vector<Motion<double>>& motions) {
  constexpr double step = 1e-5;  // changes are nearly linear, so differences are as good as derivatives
  ManipulatorParameters above = scenario_.manipulator->parameters(), below = above;
  change(above, step);
  change(below, -step);
  const std::vector<MachineNumber> numbers = machineNumbers(above);
  Eigen::VectorXd by_x(static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k)
    by_x(static_cast<Eigen::Index>(k)) = (numbers[k].get(above) - numbers[k].get(below)) / (2 * step);
  std::vector<Vector6d> out;
  for (const EffortDerivatives::Columns& J : byNumbers(motions)) out.emplace_back(J * by_x);
  return out;
}

const std::vector<EffortDerivatives::Columns>& MachineSlopes::byNumbers(const std::vector<Motion<double>>& motions) {
  std::vector<double> instants;
  for (const Motion<double>& motion : motions) instants.push_back(motion.t);
  if (instants == instants_) return by_numbers_;
  by_numbers_.clear();
  for (const Motion<double>& motion : motions)
    by_numbers_.push_back(derivatives_.byParameters(motion, loadAtP(scenario_.load.get(), motion)));
  instants_ = std::move(instants);
  return by_numbers_;
}

}  // namespace ursula
