#include "validation/subject/parameters.h"

#include <Eigen/Geometry>

namespace ursula {

void Parameter::disturb(ManipulatorParameters& machine, double relative) const {
  if (turns) {
    Vector3d& u = machine.legs[leg].base_axis;
    const Vector3d across = u.unitOrthogonal();
    const Vector3d about = entry == 0 ? across : Vector3d(u.normalized().cross(across));
    u = Eigen::AngleAxisd(relative, about) * u;
    return;
  }
  const double value = get(machine), size = this->size(machine);
  if (entries == 1)
    set(machine, value * (1 + relative));
  else
    set(machine, value + relative * (size > 0 ? size : 1));
}

std::vector<Parameter> allParameters(const Manipulator& machine) {
  std::vector<Parameter> out;
  for (const MachineNumber& number : machineNumbers(machine.parameters())) {
    Parameter parameter{number};
    if (number.quantity == Quantity::base_axis) {
      if (number.entry == 2) continue;
      parameter.path.replace(parameter.path.size() - 1, 1, number.entry == 0 ? "across" : "along");
      parameter.words = number.entry == 0 ? "base axis (turned one way)" : "base axis (turned the other way)";
      parameter.unit = "rad";
      parameter.turns = true;
    }
    out.push_back(parameter);
  }
  return out;
}

}  // namespace ursula
