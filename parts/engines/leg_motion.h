#pragma once

#include <array>

#include "model/legs/leg_chain.h"
#include "model/load.h"
#include "model/open_tree.h"

namespace ursula {

// A leg's motion, its friction and the load, for engines that lack them.

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

struct LegMotion {
  Vector3d q = Vector3d::Zero(), rates = Vector3d::Zero(), accelerations = Vector3d::Zero();
  PlacedChain at;
  std::array<ChainBody, 2> bodies;
};

/// The platform as a body with its origin in P.
ChainBody platformOf(const Motion<double>& motion);

/// Returns the leg's coordinates at the motion's pose, by geometry. They lose half the digits if the leg is nearly
/// stretched. Throws std::domain_error if the leg cannot reach; the message names leg `index` + 1.
Vector3d legCoordinates(const Leg& leg, int index, const Matrix3d& frame, const Motion<double>& motion);

/// Returns the leg's state at the motion, with coordinates to rounding. Without `with_bias` its accelerations lack J̇ u.
/// Throws std::domain_error if the leg cannot reach.
LegMotion legState(const LegChain& chain, const Leg& leg, int index, const Motion<double>& motion, bool with_bias);

/// Returns the friction forces that act on a leg's three coordinates.
Vector3d frictionOn(const Leg& leg, const Vector3d& rates);

/// Returns a load's [moment about P; force] in B; zero without a load.
Vector6d loadInBase(const Load* load, double t, const Matrix3d& Q);

}  // namespace ursula
