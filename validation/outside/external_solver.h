#pragma once

#include <string>

#include "model/scenario.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/outside/line_process.h"
#include "validation/outside/outside_simulator.h"
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

/// The same for a mechanism: a line has t, the motors' q, rates and accelerations, then the same of all other joints.
/// URSULA_COLUMNS names them, and URSULA_MODEL is the model's path.
ValidationResult validateExternalSolver(const MechanismScenario& scenario, const ExternalSolverOptions& options,
                                        const MechanismOptions& validation = {});

/// Validates a separate process as a simulator: a line has t, p, q, v, w and the motors' efforts, and its answer is
/// a_x, …, alpha_z, the platform's acceleration in B. For a mechanism a line has t, the motors' q and rates, the values
/// and rates of all other joints, and the efforts; its answer is the accelerations of the motors' coordinates.
ValidationResult validateExternalSimulator(const Scenario& scenario, const ExternalSolverOptions& options,
                                           const ValidationOptions& validation = {});
ValidationResult validateExternalSimulator(const MechanismScenario& scenario, const ExternalSolverOptions& options,
                                           const MechanismOptions& validation = {});

}  // namespace ursula
