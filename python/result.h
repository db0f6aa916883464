#pragma once

#include <ursula/validate.h>

#include "python/made.h"

template <>
class pybind11::detail::type_caster<ursula::Check> : public ursula::python::MadeCaster<ursula::Check> {};
template <>
class pybind11::detail::type_caster<ursula::Finding> : public ursula::python::MadeCaster<ursula::Finding> {};
template <>
class pybind11::detail::type_caster<ursula::NamedCause> : public ursula::python::MadeCaster<ursula::NamedCause> {};
template <>
class pybind11::detail::type_caster<ursula::EffortDeviation>
    : public ursula::python::MadeCaster<ursula::EffortDeviation> {};
template <>
class pybind11::detail::type_caster<ursula::ReplayError> : public ursula::python::MadeCaster<ursula::ReplayError> {};
template <>
class pybind11::detail::type_caster<ursula::ValidationResult>
    : public ursula::python::MadeCaster<ursula::ValidationResult> {};
