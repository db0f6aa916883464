#pragma once

#include "model/legs/leg_chain.h"
#include "model/load.h"
#include "model/open_tree.h"

namespace ursula {

// A leg's coordinates, its friction and the load, for engines that lack them.

/// Returns the leg's coordinates at the motion's pose, by geometry. They lose half the digits if the leg is nearly
/// stretched. Throws std::domain_error if the leg cannot reach; the message names leg `index` + 1.
Vector3d legCoordinates(const Leg& leg, int index, const Matrix3d& frame, const Motion<double>& motion);

/// Returns the friction forces that act on a leg's three coordinates.
Vector3d frictionOn(const Leg& leg, const Vector3d& rates);

/// Returns a load's [moment about P; force] in B; zero without a load.
Vector6d loadInBase(const Load* load, double t, const Matrix3d& Q);

}  // namespace ursula
