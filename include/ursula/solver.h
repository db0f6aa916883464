#pragma once

/// \file
/// The paper's closed forms: Solver for kinematics and dynamics, BatchDynamics for many poses at a time,
/// EffortDerivatives, DirectKinematics for all poses.

#include "include/ursula/abi.h"
#include "nocsolver/batch_dynamics.h"
#include "nocsolver/direct_kinematics.h"
#include "nocsolver/effort_derivatives.h"
#include "nocsolver/solver.h"
