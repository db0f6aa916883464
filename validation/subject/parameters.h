#pragma once

#include <vector>

#include "model/machine_numbers.h"

namespace ursula {

/// A number of the machine to disturb. Of an axis it may also be one of two rotations perpendicular to it:
/// "manipulator.leg.2.base_axis.across", rad.
struct Parameter : MachineNumber {
  bool turns = false;  ///< whether it is such a rotation

  /// Applies a relative error. It is relative to the largest moment for an inertia entry, and to the vector's norm (or
  /// one metre if that is zero) for a point. For an axis it is an angle.
  void disturb(ManipulatorParameters& machine, double relative) const;
};

/// All numbers that affect the machine, in the order of machineNumbers.
std::vector<Parameter> allParameters(const Manipulator& machine);

}  // namespace ursula
