#pragma once

#include <string>

#include "model/scenario.h"
#include "validation/outside/outside_solver.h"
#include "validation/outside/solver_line.h"

namespace ursula {

struct ExternalSolverOptions {
  std::string command;  ///< for `sh -c`
  double timeout = 10;  ///< for an answer, s
};

/// The whole validation of a scenario with a process of its own on trial, which is started once and has
/// URSULA_SCENARIO, the scenario's path, in its environment. Throws as validateOutside() does, SolverProcessError, and
/// std::system_error where it cannot be started.
ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation = {});

}  // namespace ursula
