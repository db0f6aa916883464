#pragma once

#include <vector>

#include "model/machine_numbers.h"

namespace ursula {

/// A number of the machine that is made wrong. Of an axis it is one of two turns across it:
/// "manipulator.leg.2.base_axis.across", rad.
struct Parameter : MachineNumber {
  bool turns() const { return quantity == Quantity::base_axis; }
  /// By a relative error: of the largest moment for an inertia entry, of the vector's norm for points (of one metre
  /// where that is zero), by that angle for axes.
  void disturb(ManipulatorParameters& machine, double relative) const;
};

/// All that matter for the machine, in the order of machineNumbers.
std::vector<Parameter> allParameters(const Manipulator& machine);

}  // namespace ursula
