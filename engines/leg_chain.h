#pragma once

#include <Eigen/Geometry>
#include <array>

#include "engines/open_tree.h"
#include "model/load.h"
#include "model/manipulator.h"

namespace ursula {

// Geometry of a leg for engines that have no inverse kinematics or no accelerations of their own.

/// Returns [x̂, û, ẑ] with a horizontal x̂.
Matrix3d fixedFrame(const Leg& leg);
/// Returns the rotation that turns z to û and keeps x, so that the second angle counts from û.
Matrix3d alongAxis();
/// Returns a leg's coordinates for B at `k` from A in the frame [x̂, û, ẑ]. They lose digits if the leg is nearly
/// stretched. Throws std::domain_error if the leg cannot reach; the message names leg `index` + 1.
Vector3d legCoordinates(const Leg& leg, int index, const Vector3d& k);

/// A leg as three joints of one axis each. The bodies' frames are those of the scenario, with origins at the links'
/// first ends; a rod in a cylinder has its origin at its inner end.
struct LegChain {
  struct Joint {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();  ///< from the joint's frame to the one before it
    Vector3d axis = Vector3d::Zero();                         ///< unit vector in the joint's frame
    bool slides = false;
    int body = -1;  ///< body behind the joint: 0 proximal, 1 distal; -1 if the next joint follows at once
  };
  std::array<Joint, 3> joints;
  std::array<Link, 2> links;
  std::array<Vector3d, 2> centers;  ///< mass centres in the bodies' frames, m
  Vector3d tip;                     ///< the leg's point in the distal body's frame, m

  /// The body that the j-th joint moves first.
  std::size_t bodyOf(std::size_t j) const {
    return static_cast<std::size_t>(joints[j].body >= 0 ? joints[j].body : joints[j + 1].body);
  }
};
LegChain chainOf(const Leg& leg);

/// A body's frame, angular velocity and acceleration, and its origin's velocity and acceleration; in B.
struct ChainBody {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  Vector3d omega = Vector3d::Zero(), velocity = Vector3d::Zero();
  Vector3d alpha = Vector3d::Zero(), acceleration = Vector3d::Zero();

  /// Velocity and acceleration of the body's point `at`, given in B.
  Vector3d velocityOf(const Vector3d& at) const { return velocity + omega.cross(at - frame.translation()); }
  Vector3d accelerationOf(const Vector3d& at) const {
    const Vector3d arm = at - frame.translation();
    return acceleration + alpha.cross(arm) + omega.cross(omega.cross(arm));
  }
};

struct LegState {
  Vector3d q = Vector3d::Zero(), rates = Vector3d::Zero(), accelerations = Vector3d::Zero();
  std::array<ChainBody, 2> bodies;
  std::array<Vector3d, 3> axes, anchors;  ///< the joints' unit axes and points on them, in B
  Vector3d tip = Vector3d::Zero();        ///< in B
  Matrix3d J = Matrix3d::Zero();          ///< velocity of the tip per unit rates
};

/// Fills all but q, rates and accelerations from these.
void moveChain(const LegChain& chain, LegState& state);

/// The platform as a body with its origin in P.
ChainBody platformOf(const Motion<double>& motion);

/// Returns the leg's state at the motion. Without `with_bias` its accelerations lack J̇ u. Throws std::domain_error if
/// the leg cannot reach.
LegState legState(const LegChain& chain, const Leg& leg, int index, const Motion<double>& motion, bool with_bias);

/// Returns the friction forces that act on a leg's three coordinates.
Vector3d frictionOn(const Leg& leg, const Vector3d& rates);

/// Returns a load's [moment about P; force] in B; zero without a load.
Vector6d loadInBase(const Load* load, double t, const Matrix3d& Q);

}  // namespace ursula
