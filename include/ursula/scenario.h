#pragma once

/// \file
/// The machine and its task: Manipulator, Trajectory, Load, and the Scenario that holds them.

#include "base/errors.h"
#include "include/ursula/abi.h"
#include "model/instants.h"
#include "model/quaternions.h"
#include "model/scenario.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_json.h"
#include "model/trajectories/trajectories.h"
