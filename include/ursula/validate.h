#pragma once

/// \file
/// The verdict: validate() on a Scenario and a Subject gives a ValidationResult.

#include "base/text.h"
#include "include/ursula/abi.h"
#include "validation/outside/outside_simulator.h"
#include "validation/outside/outside_solver.h"
#include "validation/validate.h"
