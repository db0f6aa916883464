#pragma once

#include <pybind11/pybind11.h>

namespace ursula::python {

/// Adds identify() and excite().
void addIdentification(pybind11::module_& module);

}  // namespace ursula::python
