#pragma once

#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// Kinds of quantities, in the order of their names in machine_numbers.cpp.
enum class NumberGroup { gravity, mass, center, inertia, length, point, axis, friction, rotor };
/// "gravity", "mass", …
const char* name(NumberGroup group);

enum class NumberBody { none, platform, proximal, distal };
/// "platform", "proximal" or "distal"; empty for none.
const char* name(NumberBody body);

enum class Quantity {
  gravity,
  platform_mass,
  platform_center,
  platform_inertia,
  base_point,
  platform_point,
  base_axis,
  length,
  mass,
  center,
  inertia,
  friction,
  coulomb,
  smoothing_speed,
  sliding_speed,
  rotor_inertia,
  center_across
};

/// One number of the machine; everything that names it uses this name.
struct MachineNumber {
  Quantity quantity;
  int leg = -1;  ///< 0-based; −1 for gravity and the platform
  NumberBody body = NumberBody::none;
  int entry = 0;     ///< index in a vector; in a tensor's xx, yy, zz, xy, xz, yz; in the leg's coordinates for friction
  int entries = 1;   ///< number of entries: 3 for a vector, 6 for a tensor
  std::string path;  ///< as in a scenario and as a sweep's key: "manipulator.leg.2.distal.inertia.3"
  std::string words;  ///< "inertia xy", without its owner
  std::string unit;   ///< "kg m^2"

  NumberGroup group() const;
  /// Whether efforts are linear in it, if first moments replace mass centres, and inertias are those about a body's
  /// end.
  bool isLinear() const;
  double get(const ManipulatorParameters& machine) const;
  /// Sets both entries of an off-diagonal pair of an inertia.
  void set(ManipulatorParameters& machine, double value) const;
  /// Returns the norm of its vector, the largest entry of its tensor, or its own absolute value.
  double size(const ManipulatorParameters& machine) const;
};

/// Returns all numbers that efforts can depend on: 13 of gravity and platform, then those of each leg. A cylinder's
/// length, which only limits its stroke, is omitted; so is everything of a carriage except its mass. A scenario's
/// `smoothing_speed` gives two numbers; `sliding_speed` is that of d. Rotor inertias appear only if the machine has
/// them. A mass centre is one number, or three if it is off the link's line.
std::vector<MachineNumber> machineNumbers(const ManipulatorParameters& machine);

/// Row and column of a tensor's entries, in the order of a scenario.
inline constexpr int tensor_entries[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

}  // namespace ursula
