#pragma once

#include <vector>

#include "model/mechanism.h"

namespace ursula::loops {

/// What acts along one coordinate of a joint, beside a motor.
struct CoordinateLoad {
  double damping = 0, friction = 0, speed = 1, rotor = 0, stiffness = 0, spring_reference = 0;
  double position = 0;  ///< the file's coordinate at the reference pose

  bool acts() const { return damping != 0 || friction != 0 || rotor != 0 || stiffness != 0; }
};

enum class ElementKind { turn, slide, ball };

/// One step of the spanning tree: it carries a frame from the frame before it, by one coordinate, or by three if it is
/// a ball. Centre and axis are in the world at the reference pose, where all frames coincide.
struct Element {
  ElementKind kind = ElementKind::turn;
  int before = -1;        ///< element that carries it; −1 for the ground
  int first = 0;          ///< index of its first rate
  std::size_t joint = 0;  ///< of the mechanism
  bool reversed = false;  ///< it leads from the joint's child to its parent
  int axis_of_joint = 0;  ///< 0 or 1; 0 to 2 for a free joint's translations
  Vector3d centre = Vector3d::Zero(), axis = Vector3d::Zero();
  CoordinateLoad load;

  int rates() const { return kind == ElementKind::ball ? 3 : 1; }
};

/// The spanning tree of a mechanism and the joints that it cuts. It keeps motors, then loaded joints, then the file's
/// own tree; the file's closures go first. Joints lead outwards from the ground, against their own sense where needed.
struct LoopTree {
  explicit LoopTree(const Mechanism& mechanism);

  std::vector<Element> elements;          ///< each after the one that carries it
  std::vector<int> element_of_body;       ///< −1 for bodies that stand still
  std::vector<std::size_t> cut;           ///< joints of the mechanism
  std::vector<int> rate_of_motor;         ///< index of each motor's rate
  std::vector<std::vector<int>> path_to;  ///< elements from the ground to each element, itself last
  int rate_count = 0;
};

/// Returns what acts along a coordinate of the joint.
CoordinateLoad loadOf(const MechanismJoint& joint);

}  // namespace ursula::loops
