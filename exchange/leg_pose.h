#pragma once

#include <Eigen/Geometry>
#include <array>
#include <stdexcept>

#include "base/scalar.h"
#include "model/manipulator.h"

namespace ursula::exchange {

/// A pose that a leg cannot take. Gives the leg, counted from 1, the number and its bound.
class UnreachablePose : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// A coordinate of a leg at a pose, with its joint; vectors in B.
struct JointAt {
  Coordinate coordinate = Coordinate::phi;
  Vector3d centre = Vector3d::Zero();  ///< m
  Vector3d axis = Vector3d::Zero();    ///< unit; the coordinate grows about or along it
  double position = 0;                 ///< rad or m
};

/// A leg at a pose, in B.
struct LegPose {
  std::array<JointAt, 3> joints;        ///< in the order of the kind's coordinates
  Eigen::Isometry3d proximal, distal;   ///< frames of the links, at their first ends
  Vector3d tip = Vector3d::Zero();      ///< the platform's point Bᵢ, m
  Vector3d far_end = Vector3d::Zero();  ///< far end of the proximal link, m
};

/// Places leg `index`, 0-based, so that it ends at `tip`, m, in B, by closed forms. Throws UnreachablePose if the tip
/// is out of reach, the stroke ends, or the leg is singular.
LegPose legPose(const Leg& leg, int index, const Vector3d& tip);

}  // namespace ursula::exchange
