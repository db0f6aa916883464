#pragma once

#include <pybind11/pybind11.h>
#include <ursula/exchange.h>
#include <ursula/scenario.h>
#include <ursula/solver.h>

#include <memory>
#include <utility>
#include <vector>

#include "python/made.h"

namespace ursula::python {

/// A scenario with the solver for its machine.
struct ScenarioWithSolver {
  explicit ScenarioWithSolver(Scenario given)
      : scenario(std::move(given)),
        kinematics(*scenario.manipulator),
        derivatives(*scenario.manipulator),
        batch(*scenario.manipulator) {}

  Scenario scenario;
  std::vector<exchange::Assumption> assumptions;  ///< of an imported model
  DirectKinematics kinematics;
  EffortDerivatives derivatives;
  BatchDynamics batch;
};

/// Throws TypeError with the function's name and what is expected unless the object is a Scenario.
void requireScenario(const char* function, const pybind11::object& given,
                     const char* expected = "ursula.Scenario or ursula.MechanismScenario");

void addScenario(pybind11::module_& module);

/// Warns (UserWarning) of what `check` lists for a scenario that was read, once, at the caller's line. Is called
/// without Python's lock.
std::shared_ptr<ScenarioWithSolver> warnedOf(std::shared_ptr<ScenarioWithSolver> read);

}  // namespace ursula::python
