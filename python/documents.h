#pragma once

#include "python/derivatives.h"

namespace ursula::python {

/// Adds scenarios from dicts and text, and the reverse.
void addDocuments(pybind11::module_& module, ScenarioClass& scenario);

}  // namespace ursula::python
