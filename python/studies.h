#pragma once

#include <pybind11/pybind11.h>

namespace ursula::python {

/// What is asked beside a verdict: simulate, check, map, compare.
void addStudies(pybind11::module_& module);

}  // namespace ursula::python
