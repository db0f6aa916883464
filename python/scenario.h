#pragma once

#include <pybind11/pybind11.h>
#include <ursula/scenario.h>
#include <ursula/solver.h>

#include <filesystem>

namespace ursula::python {

/// A scenario with the solver for its machine.
struct ScenarioWithSolver {
  explicit ScenarioWithSolver(const std::filesystem::path& file)
      : scenario(readScenario(file)),
        kinematics(*scenario.manipulator),
        derivatives(*scenario.manipulator),
        batch(*scenario.manipulator) {}

  Scenario scenario;
  DirectKinematics kinematics;
  EffortDerivatives derivatives;
  BatchDynamics batch;
};

void addScenario(pybind11::module_& module);

}  // namespace ursula::python
