#pragma once

#include "model/joint_reactions.h"
#include "nocsolver/solver.h"

namespace ursula {

/// The reactions that the orthogonal complement eliminates, recovered from Newton and Euler (28), body by body from the
/// platform to the base, for the torques of inverseDynamics at the motion. `work` is what inverseKinematics leaves.
Reactions recoverReactions(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& torques,
                           Workspace<double>& work);

}  // namespace ursula
