#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"

// A scenario as a list of named numbers, to ask of many scenarios which of them differ.

namespace ursula {

/// A number of the machine, by name; `leg` is -1 for what is no leg's.
struct MachineNumber {
  std::string name;
  int leg = -1;
  std::function<double&(ManipulatorParameters&)> at;
  bool may_be_zero = false;  ///< in many scenarios: where there is no gravity or no friction
};

/// All continuous fields of ManipulatorParameters.
inline std::vector<MachineNumber> machineNumbers() {
  using Machine = ManipulatorParameters;
  std::vector<MachineNumber> out;
  int leg = -1;
  const auto add = [&](const std::string& name, std::function<double&(Machine&)> at, bool may_be_zero = false) {
    out.push_back({name, leg, std::move(at), may_be_zero});
  };
  const auto addVector = [&](const std::string& name, const std::function<Vector3d&(Machine&)>& vector) {
    for (int k = 0; k < 3; ++k)
      add(name + "." + "xyz"[k], [=](Machine& machine) -> double& { return vector(machine)(k); });
  };
  const auto addInertia = [&](const std::string& name, const std::function<Matrix3d&(Machine&)>& inertia) {
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        add(name + ".inertia." + "xyz"[i] + "xyz"[j],
            [=](Machine& machine) -> double& { return inertia(machine)(i, j); });
  };
  const auto addFriction = [&](const std::string& name, const std::function<JointFriction&(Machine&)>& friction) {
    add(
        name + ".actuated", [=](Machine& machine) -> double& { return friction(machine).phi; }, true);
    add(
        name + ".universal", [=](Machine& machine) -> double& { return friction(machine).psi; }, true);
    add(
        name + ".knee", [=](Machine& machine) -> double& { return friction(machine).theta; }, true);
  };
  addVector("gravity", [](Machine& machine) -> Vector3d& { return machine.gravity; });
  add("platform.mass", [](Machine& machine) -> double& { return machine.platform.mass; });
  addVector("platform.center_of_mass", [](Machine& machine) -> Vector3d& { return machine.platform.center_of_mass; });
  addInertia("platform", [](Machine& machine) -> Matrix3d& { return machine.platform.inertia; });
  for (leg = 0; leg < leg_count; ++leg) {
    const auto i = static_cast<std::size_t>(leg);
    const std::string place = "leg[" + std::to_string(leg + 1) + "].";
    addVector(place + "base_point", [i](Machine& machine) -> Vector3d& { return machine.legs[i].base_point; });
    addVector(place + "base_axis", [i](Machine& machine) -> Vector3d& { return machine.legs[i].base_axis; });
    addVector(place + "platform_point", [i](Machine& machine) -> Vector3d& { return machine.legs[i].platform_point; });
    for (const bool proximal : {true, false}) {
      const auto link = [=](Machine& machine) -> Link& {
        return proximal ? machine.legs[i].proximal : machine.legs[i].distal;
      };
      const std::string of = place + (proximal ? "proximal" : "distal");
      add(of + ".length", [=](Machine& machine) -> double& { return link(machine).length; });
      add(of + ".mass", [=](Machine& machine) -> double& { return link(machine).mass; });
      add(of + ".center_of_mass", [=](Machine& machine) -> double& { return link(machine).center_of_mass; });
      addInertia(of, [=](Machine& machine) -> Matrix3d& { return link(machine).inertia; });
    }
    addFriction(place + "friction", [i](Machine& machine) -> JointFriction& { return machine.legs[i].friction; });
    addFriction(place + "coulomb", [i](Machine& machine) -> JointFriction& { return machine.legs[i].coulomb; });
    add(place + "coulomb.smoothing_speed",
        [i](Machine& machine) -> double& { return machine.legs[i].coulomb.smoothing_speed; });
  }
  return out;
}

struct NamedNumber {
  std::string name;
  double value = 0;
};

/// Duration and the motion at three instants.
inline std::vector<NamedNumber> motionNumbers(const Trajectory& trajectory) {
  std::vector<NamedNumber> out{{trajectory.kind() + ".duration", trajectory.duration()}};
  for (const double share : {0.0, 0.37, 1.0}) {
    const Motion<double> motion = trajectory.at(share * trajectory.duration());
    const std::string at = trajectory.kind() + " at " + std::to_string(share);
    for (int k = 0; k < 3; ++k) {
      out.push_back({at + ": p" + std::to_string(k), motion.p(k)});
      for (int j = 0; j < 3; ++j) out.push_back({at + ": Q" + std::to_string(3 * k + j), motion.Q(k, j)});
    }
  }
  return out;
}

/// Point, and the wrench at three instants.
inline std::vector<NamedNumber> loadNumbers(const Load& load, double duration) {
  const std::string kind = load.history ? "table" : "constant";
  std::vector<NamedNumber> out;
  for (int k = 0; k < 3; ++k) out.push_back({kind + " load's point" + std::to_string(k), load.point(k)});
  for (const double share : {0.0, 0.37, 1.0}) {
    const Wrench<double> wrench = load.at(share * duration);
    for (int k = 0; k < 3; ++k) {
      const std::string at = std::to_string(k) + " at " + std::to_string(share);
      out.push_back({kind + " force" + at, wrench.force(k)});
      out.push_back({kind + " moment" + at, wrench.moment(k)});
    }
  }
  return out;
}

}  // namespace ursula
