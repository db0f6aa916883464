#pragma once

#include <array>

#include "model/manipulator.h"
#include "model/motion.h"

namespace ursula::maximal {

constexpr int base_body = -1;

/// A joint between a parent, which may be the base, and a child. Bodies are numbered as in MaximalLoop.
struct Joint {
  enum class Type { revolute, universal, prismatic };

  Type type = Type::revolute;
  int parent = base_body, child = 0;
  Vector3d point = Vector3d::Zero();  ///< its centre; for a slide, a point of the child on the line
  /// Axes that the child turns about or slides along, in the order of the coordinates. On a universal joint the parent
  /// carries the first axis and the child the second.
  std::array<Vector3d, 2> axes = {Vector3d::Zero(), Vector3d::Zero()};
  Eigen::Matrix<double, 3, 2> across =
      Eigen::Matrix<double, 3, 2>::Zero();  ///< perpendicular to the slide's axis, fixed in the parent

  int rows() const { return type == Type::universal ? 4 : 5; }
  int coordinates() const { return type == Type::universal ? 2 : 1; }
};

/// The links at a pose, and their joints.
struct PlacedLeg {
  std::array<Matrix3d, 2> R;
  std::array<Vector3d, 2> c;
  std::array<Joint, 2> joints;  ///< at the base, then between the links
  Vector3d B;                   ///< centre of the ball on the platform
};

/// Places a leg by vectors and circles only. `first` and `second` number the links' bodies. Throws std::domain_error if
/// the leg cannot reach.
PlacedLeg placeLeg(const Leg& leg, int index, int first, int second, const Motion<double>& motion);

}  // namespace ursula::maximal
