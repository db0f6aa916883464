#pragma once

#include "python/derivatives.h"

namespace ursula::python {

/// Scenarios of dicts and of text, and back.
void addDocuments(pybind11::module_& module, ScenarioClass& scenario);

}  // namespace ursula::python
