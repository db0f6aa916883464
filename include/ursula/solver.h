#pragma once

/// \file
/// The paper's closed forms: Solver for inverse and direct dynamics, DirectKinematics for all poses.

#include "include/ursula/abi.h"
#include "nocsolver/direct_kinematics.h"
#include "nocsolver/solver.h"
