#pragma once

/// \file
/// The paper's closed forms: Solver for kinematics and dynamics, BatchDynamics for many poses on one or more threads,
/// EffortDerivatives, DirectKinematics for all poses.

#include "include/ursula/abi.h"
#include "nocsolver/fast/batch_dynamics.h"
#include "nocsolver/fast/effort_derivatives.h"
#include "nocsolver/fast/parallel/threaded_batch.h"
#include "nocsolver/poses/direct_kinematics.h"
#include "nocsolver/poses/ups_poses.h"
#include "nocsolver/solver.h"
