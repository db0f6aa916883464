#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// A continuous parameter of the machine: `disturb` makes it wrong by a relative error (of the largest moment for an
/// inertia entry, of the vector's norm for points, turned by that angle for axes).
struct Parameter {
  std::string name;   ///< "leg[2].proximal.mass"
  std::string group;  ///< "mass", "center", "length", "point", "axis", "inertia", "gravity", "friction"
  std::function<void(ManipulatorParameters&, double relative)> disturb;
  std::function<double(const ManipulatorParameters&)> value;  ///< SI; empty for an axis, which has none
};

/// All that matter for the machine: 13 of platform and gravity, and those of its legs.
std::vector<Parameter> allParameters(const Manipulator& machine);
/// Of a machine with such legs.
std::vector<Parameter> allParameters(const std::vector<LegKind>& legs);

}  // namespace ursula
