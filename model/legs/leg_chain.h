#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "model/manipulator.h"

namespace ursula {

// Where the parts of a leg are, for engines and for other programs' files. nocsolver/ has formulas of its own and never
// sees this folder.

/// Returns F̂ = [x̂, û, ẑ] of docs/legs.md, with a horizontal x̂.
Matrix3d fixedFrame(const Vector3d& base_axis);

/// A joint of one axis. At zero its own frame is turned by `turn` and lies at `at` in the frame before it. The second
/// joint of a universal joint has neither.
struct LegJoint {
  Vector3d axis;                                             ///< unit, in the joint's frame
  Vector3d at = Vector3d::Zero();                            ///< m
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< need not be unit

  /// Returns `turn` as a matrix; exact if its entries are small integers.
  Matrix3d rotation() const;
};
using LegJoints = std::array<LegJoint, 3>;

/// A leg as three joints of one axis each. The links' frames are those of the scenario, with origins at the links'
/// first ends; a rod in a cylinder has its origin at its inner end.
struct LegChain {
  LegKindRow row;
  Matrix3d frame;       ///< the first joint's, before its turn, in B
  Vector3d base_point;  ///< m, in B
  LegJoints joints;
  std::array<Link, 2> links;        ///< proximal, distal
  std::array<Vector3d, 2> centers;  ///< mass centres in the links' frames, m
  Vector3d far_end;                 ///< the proximal link's far end in its frame, m
  Vector3d tip;                     ///< the leg's point in the distal link's frame, m

  /// Returns the number of joints before a link's own.
  int firstOf(int link) const { return link == 0 ? 0 : row.joints_of_proximal; }
  int jointsOf(int link) const { return link == 0 ? row.joints_of_proximal : 3 - row.joints_of_proximal; }
  /// Returns the link that the j-th joint moves first.
  int linkOf(int j) const { return j < row.joints_of_proximal ? 0 : 1; }
  /// Returns whether the link follows the j-th joint at once, as it does the last of its own.
  bool movesLink(int j) const { return j + 1 == firstOf(linkOf(j)) + jointsOf(linkOf(j)); }
  bool slides(int j) const { return ursula::slides(row.coordinates[j]); }
  const LegJoint& joint(int j) const { return joints[j]; }
  /// Returns the j-th joint's frame at zero in the frame before it; the first one's is in B.
  Eigen::Isometry3d place(int j) const;
};
LegChain chainOf(const Leg& leg);
/// Returns the same, with φ counted from another frame [x, û, x × û].
LegChain chainOf(const Leg& leg, const Matrix3d& frame);

/// Returns the coordinates at which the leg's point is `AB` from the base point, in B, on the leg's own branch; φ
/// counts from `frame` [x, û, x × û]. Returns nullopt if the leg cannot reach.
std::optional<Vector3d> coordinatesAt(const Leg& leg, const Matrix3d& frame, const Vector3d& AB);

/// A leg at coordinates, in B.
struct PlacedChain {
  std::array<Eigen::Isometry3d, 2> links;  ///< the links' frames
  std::array<Vector3d, 3> axes, anchors;   ///< unit axes, and points on them
  Vector3d tip;
  Matrix3d J;  ///< velocity of the tip per unit rates
};
PlacedChain placed(const LegChain& chain, const Vector3d& q);

}  // namespace ursula
