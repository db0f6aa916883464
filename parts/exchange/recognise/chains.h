#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "parts/exchange/import.h"

namespace ursula::exchange {

/// Bodies without relative motion, which form one rigid body of the machine.
struct Group {
  std::vector<std::size_t> bodies;  ///< in the order of the file
  std::size_t foremost = 0;         ///< the body that stands where the file puts it, if a closure of the group is open
  /// The name of its foremost body, the heaviest. Bodies with three or more moving joints go first, as a payload may be
  /// heavier.
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
  void move(const Eigen::Isometry3d& by);
};

/// Throws ImportError: "body NAME", then `what`.
[[noreturn]] void refuseBody(const Group& group, const std::string& what);
/// Throws ImportError: "joint NAME", then `what`.
[[noreturn]] void refuseJoint(const GraphJoint& joint, const std::string& what);
/// Throws ImportError if a part of the group has no gravity.
void requireWeight(const Group& group);

/// Throws ImportError for what a [manipulator] has no words for, wherever it is: springs, forces of a fluid, a free
/// joint that rubs.
void requireWords(const ModelGraph& graph);

/// The machine's rigid bodies. Only moving joints remain between them.
struct Groups {
  std::vector<Group> groups;
  std::vector<std::size_t> group_of;  ///< the group of each body
  /// Displacement of each body in the world, from the file's initial pose to its place in the group.
  std::vector<Eigen::Isometry3d> moved;
  Assumptions contradictions;  ///< of closures that hold two bodies together in two ways, in m and rad, down to zero

  explicit Groups(const ModelGraph& graph);

 private:
  void unite(const ModelGraph& graph);
  void place(const ModelGraph& graph);
  void noteContradiction(const GraphJoint& joint, const Eigen::Isometry3d& off);
};

/// Returns the index of the named body. Throws ImportError with the nearest name if there is none.
std::size_t bodyNamed(const ModelGraph& graph, const std::string& name, const std::string& option);
/// Closes a loop by a ball at the origins of the frames of two links, "A:B"; `body` finds them. Returns false for a
/// text that is no pair.
bool closeAtFrames(ModelGraph& graph, const std::string& pair,
                   const std::function<std::size_t(const std::string&)>& body);

/// A single-axis joint or a ball between base and platform, at the initial pose. Its vectors are in the world.
struct Primitive {
  enum class Kind { R, P, S } kind = Kind::R;
  Vector3d axis = Vector3d::Zero();   ///< the coordinate grows as the outer part turns about it or slides along it
  Vector3d inner = Vector3d::Zero();  ///< the centre in the body towards the base
  /// Centre and axis in the body towards the platform. Only at the platform they can differ from the inner ones.
  Vector3d outer = Vector3d::Zero(), outer_axis = Vector3d::Zero();
  /// Takes the outer body, in the world, to where the joint is closed on the inner one, at the file's coordinate.
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  std::size_t joint = 0;              ///< index in the graph
  std::optional<std::size_t> behind;  ///< group between it and the next; none within a joint and at the platform
};

/// A chain from base to platform.
struct Chain {
  std::vector<Primitive> primitives;
  std::string place(const ModelGraph& graph) const;  ///< names of its joints, for messages
};

/// Adds a joint as both of its bodies have it in their groups.
void append(const ModelGraph& graph, const Groups& groups, std::size_t index, bool outwards, Chain& chain);
/// Takes the joint's inner side along by `beyond`, the displacement of the body that it is on, and makes that the one
/// of the next body. Both sides then meet, unless the next body is the platform.
void meet(Primitive& joint, bool at_platform, Eigen::Isometry3d& beyond);

struct Chains {
  std::size_t base = 0, platform = 0;  ///< groups
  std::vector<Chain> legs;  ///< in the order of their motors, if the file or the user names them, then of their joints
};

/// Returns up to twelve of the words, and how many more there are.
std::string listed(const std::vector<std::string>& words);

/// Lists the gaps of closures and `more`, those of a larger size than rounding. What exceeds 1e-3 of the machine's
/// `size`, m, or 1e-3 rad is a warning.
void sayGaps(const ModelGraph& graph, Assumptions more, double size, Assumptions& assumptions);
/// Puts warnings first, and bounds the list and its texts: what is repeated stands once, with its count.
Assumptions inOrder(Assumptions assumptions);

/// Returns the number of freedoms of the bodies that moving joints connect with the base, at the initial pose; nothing
/// if there are none or very many.
std::optional<int> freedomsOf(const ModelGraph& graph, const Groups& groups, const ImportChoices& choices);

/// Finds the legs, and moves the bodies of each so that its joints are closed from the base up to the platform's, which
/// stays. Throws ImportError with the bodies and joints that prevent it.
Chains findChains(const ModelGraph& graph, Groups& groups, const ImportChoices& choices, Assumptions& assumptions);

}  // namespace ursula::exchange
