#pragma once

/// \file
/// What the machine is and what it is asked to do: Manipulator, Trajectory, Load, and the Scenario that holds them.

#include "base/errors.h"
#include "include/ursula/abi.h"
#include "model/instants.h"
#include "model/quaternions.h"
#include "model/scenario.h"
#include "model/scenario_json.h"
#include "model/trajectories/trajectories.h"
