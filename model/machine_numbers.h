#pragma once

#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

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

/// A number of the machine. Whatever names one has the name from here.
struct MachineNumber {
  Quantity quantity;
  int leg = -1;       ///< 0-based; −1 of gravity and the platform
  std::string body;   ///< "platform", "proximal" or "distal"; empty where it is no body's
  int entry = 0;      ///< of a vector; of a tensor's xx, yy, zz, xy, xz, yz; of the leg's coordinates for friction
  int entries = 1;    ///< of what it is an entry of: 3 of a vector, 6 of a tensor
  std::string path;   ///< as in a scenario and as the key of a sweep: "manipulator.leg.2.distal.inertia.3"
  std::string group;  ///< "gravity", "mass", "center", "inertia", "length", "point", "axis", "friction" or "rotor"
  std::string words;  ///< "inertia xy"; whose it is they do not say
  std::string unit;   ///< "kg m^2"

  double get(const ManipulatorParameters& machine) const;
  /// An inertia's xy is yx as well.
  void set(ManipulatorParameters& machine, double value) const;
  /// Norm of the vector that it is an entry of, largest entry of the tensor, or its own.
  double size(const ManipulatorParameters& machine) const;
};

/// All that efforts can depend on: 13 of gravity and platform, then those of each leg. Left out are the length of a
/// cylinder, which says where its stroke ends, and of a carriage all but its mass. The one `smoothing_speed` of a
/// scenario is two numbers: `sliding_speed` is that of d. Rotors' inertia and mass centres off a link's line are
/// numbers of a machine that has them; the line is then the third entry of the mass centre.
std::vector<MachineNumber> machineNumbers(const ManipulatorParameters& machine);

/// Row and column of a tensor's entries, in the order in which a scenario gives them.
inline constexpr int tensor_entries[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

}  // namespace ursula
