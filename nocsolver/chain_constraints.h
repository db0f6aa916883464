#pragma once

#include "nocsolver/chain_solver.h"

namespace ursula {

/// D of the velocity constraints D t = 0 that the complement is orthogonal to, D T = 0, for legs of any kind: at each
/// joint what it does not let move, of its axes and points alone. Twelve rows a leg; columns are twists [ω; ċ] of the
/// links and the platform in the order of twistShaping(). `work` as inverseKinematics left it. Allocates.
Eigen::MatrixXd velocityConstraints(const ChainSolver<double>& solver, const Motion<double>& motion,
                                    const ChainWorkspace<double>& work);

}  // namespace ursula
