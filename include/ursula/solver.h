#pragma once

/// \file
/// The paper's closed forms: Solver for kinematics and dynamics, BatchDynamics for many poses on one or more threads,
/// EffortDerivatives, DirectKinematics for all poses.

#include "include/ursula/abi.h"
#include "parts/derivatives/effort_derivatives.h"
#include "parts/fast/batch_dynamics.h"
#include "parts/fast/solver.h"
#include "parts/fast/threaded_batch.h"
#include "parts/poses/direct_kinematics.h"
#include "parts/poses/ups_poses.h"
