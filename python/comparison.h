#pragma once

#include <pybind11/pybind11.h>

namespace ursula::python {

void addComparison(pybind11::module_& module);

}  // namespace ursula::python
