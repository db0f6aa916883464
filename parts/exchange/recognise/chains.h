#pragma once

#include <optional>
#include <string>
#include <vector>

#include "parts/exchange/import.h"

namespace ursula::exchange {

/// Bodies without relative motion, which form one rigid body of the machine.
struct Group {
  std::vector<std::size_t> bodies;  ///< in the order of the file
  /// The name of its heaviest body. Bodies with three or more moving joints go first, as a payload may be heavier.
  std::string name;
  int line = 0;
  bool fixed = false;
  double mass = 0;
  Vector3d center_of_mass = Vector3d::Zero();  ///< in the world
  Matrix3d inertia = Matrix3d::Zero();         ///< about the mass centre, world axes
  double inertia_rounding = 0;
  bool weightless = false;  ///< some of its mass has no gravity

  /// Returns whether the group has neither mass nor inertia, as a frame between two joints of one point.
  bool isFrame() const { return mass == 0 && inertia.isZero(0); }
  /// Returns the tensor about `point`.
  Matrix3d inertiaAbout(const Vector3d& point) const;
  /// Adds another body by the parallel-axis rule.
  void add(double mass_of_it, const Vector3d& center, const Matrix3d& inertia_of_it);
};

/// Throws ImportError: "body NAME", then `what`.
[[noreturn]] void refuseBody(const Group& group, const std::string& what);
/// Throws ImportError: "joint NAME", then `what`.
[[noreturn]] void refuseJoint(const GraphJoint& joint, const std::string& what);
/// Throws ImportError if a part of the group has no gravity.
void requireWeight(const Group& group);

/// The machine's rigid bodies. Only moving joints remain between them.
struct Groups {
  std::vector<Group> groups;
  std::vector<std::size_t> group_of;  ///< the group of each body

  explicit Groups(const ModelGraph& graph);
};

/// Returns the index of the named body. Throws ImportError with the nearest name if there is none.
std::size_t bodyNamed(const ModelGraph& graph, const std::string& name, const std::string& option);

/// A single-axis joint or a ball between base and platform, at the initial pose. Its vectors are in the world.
struct Primitive {
  enum class Kind { R, P, S } kind = Kind::R;
  Vector3d axis = Vector3d::Zero();   ///< the coordinate grows as the outer part turns about it or slides along it
  Vector3d inner = Vector3d::Zero();  ///< the centre in the body towards the base
  Vector3d outer = Vector3d::Zero();  ///< the centre in the body towards the platform
  std::size_t joint = 0;              ///< index in the graph
  std::optional<std::size_t> behind;  ///< group between it and the next; none within a joint and at the platform
};

/// A chain from base to platform.
struct Chain {
  std::vector<Primitive> primitives;
  std::string place(const ModelGraph& graph) const;  ///< names of its joints, for messages
};

struct Chains {
  std::size_t base = 0, platform = 0;  ///< groups
  std::vector<Chain> legs;  ///< in the order of their motors, if the file or the user names them, then of their joints
};

/// Throws ImportError with the bodies and joints that prevent it.
Chains findChains(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices,
                  Assumptions& assumptions);

}  // namespace ursula::exchange
