#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "python/scenario.h"

namespace ursula::python {

using ScenarioClass = pybind11::class_<ScenarioWithSolver, std::shared_ptr<ScenarioWithSolver>>;

void addDerivatives(ScenarioClass& scenario);

}  // namespace ursula::python
