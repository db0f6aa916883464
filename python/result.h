#pragma once

#include <ursula/validate.h>

#include "python/made.h"

template <>
class pybind11::detail::type_caster<ursula::Check> : public ursula::python::MadeCaster<ursula::Check> {};
template <>
class pybind11::detail::type_caster<ursula::ValidationResult>
    : public ursula::python::MadeCaster<ursula::ValidationResult> {};
