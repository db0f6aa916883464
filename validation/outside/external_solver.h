#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "model/scenario.h"
#include "validation/outside/outside_solver.h"

namespace ursula {

/// The solver's process did not answer as it has to: with what it was asked and what came.
class SolverProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ExternalSolverOptions {
  std::string command;  ///< for `sh -c`
  double timeout = 10;  ///< for an answer, s
};

/// What a solver's process is asked for a motion, without the line's end: t, p, q, v, w, a, alpha as in the program's
/// files, in B, SI, q with w ≥ 0, 17 significant digits, commas between.
std::string solverQuestion(const Motion<double>& motion);

/// Six numbers with commas between, efforts in the order of the motors, N·m or N. Throws SolverProcessError that says
/// what is wrong with `line`.
Vector6d solverAnswer(const std::string& line);

/// The whole validation of a scenario with a process of its own on trial, which is started once and has
/// URSULA_SCENARIO, the scenario's path, in its environment. Throws as validateOutside() does, SolverProcessError, and
/// std::system_error where it cannot be started.
ValidationResult validateExternalSolver(const Scenario& scenario, const ExternalSolverOptions& options,
                                        const ValidationOptions& validation = {});

}  // namespace ursula
