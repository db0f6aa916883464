#pragma once

#include <string>

#include "model/scenario.h"
#include "validation/outside/line_process.h"
#include "validation/outside/outside_solver.h"

namespace ursula {

struct ExternalSolverOptions {
  std::string command;  ///< for `sh -c`
  double timeout = 10;  ///< for one answer, s
};

/// Validates a scenario with a separate process as the solver under test. The process starts once, with the scenario's
/// path as URSULA_SCENARIO in its environment. Throws like validateOutside(), SolverProcessError, and std::system_error
/// if it cannot be started.
ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation = {});

}  // namespace ursula
