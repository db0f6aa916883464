#pragma once

/// \file
/// Machines with any closed loops: readMechanism() reads a scenario with [mechanism], MechanismAlong and LoopSolver
/// give its inverse and direct dynamics, validateMechanism() judges it, or a MechanismSubject, and gives a
/// ValidationResult.

#include "include/ursula/abi.h"
#include "model/mechanism_scenario.h"
#include "nocsolver/loops/loop_solver.h"
#include "validation/mechanism/validate_mechanism.h"
