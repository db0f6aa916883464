#pragma once

#include <array>

#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula::maximal {

constexpr int base_body = -1;

/// Between a parent, which may be the base, and a child. Bodies are numbered as MaximalLoop has them.
struct Joint {
  enum class Type { revolute, universal, prismatic };

  Type type = Type::revolute;
  int parent = base_body, child = 0;
  Vector3d point = Vector3d::Zero();  ///< its centre; of a slide a point of the child on the line
  /// What the child turns about or slides along, in the order of the coordinates; of a universal joint the first is
  /// carried by the parent and the second by the child.
  std::array<Vector3d, 2> axes = {Vector3d::Zero(), Vector3d::Zero()};
  Eigen::Matrix<double, 3, 2> across = Eigen::Matrix<double, 3, 2>::Zero();  ///< to the one axis, carried by the parent

  int rows() const { return type == Type::universal ? 4 : 5; }
  int coordinates() const { return type == Type::universal ? 2 : 1; }
};

/// The links at a pose, and what holds them.
struct PlacedLeg {
  std::array<Matrix3d, 2> R;
  std::array<Vector3d, 2> c;
  std::array<Joint, 2> joints;  ///< at the base, then between the links
  Vector3d B;                   ///< of the ball on the platform
};

/// By vectors and circles alone. `first` and `second` number the links' bodies. Throws std::domain_error where the leg
/// cannot reach.
PlacedLeg placeLeg(const Leg& leg, int index, int first, int second, const Motion<double>& motion);

}  // namespace ursula::maximal
