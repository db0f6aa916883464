#pragma once

#include <vector>

#include "parts/engines/joint_rows.h"

namespace ursula {

/// A step of the spanning tree of welds, outwards. Without a joint the weld is free.
struct WeldStep {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t joint = none, from = 0, to = 0;
  bool reversed = false;  ///< from the joint's child to its parent
};
struct WeldTree {
  std::vector<WeldStep> steps;
  std::vector<std::size_t> cut;
};
/// The file's own tree: motors and loaded joints are in it before others. The file's closures are not, unless they are
/// motors or loaded, and open joints never.
WeldTree weldTree(const Mechanism& mechanism, const WeldedMechanism& welded);

}  // namespace ursula
