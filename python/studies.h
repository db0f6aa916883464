#pragma once

#include <pybind11/pybind11.h>

namespace ursula::python {

/// Adds the functions beside validation: simulate, check, map, compare.
void addStudies(pybind11::module_& module);

}  // namespace ursula::python
