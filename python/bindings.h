#pragma once

#include <pybind11/pybind11.h>
#include <memory>
#include <string>

#include "python/lock.h"
#include "python/scenario.h"

namespace ursula::python {

/// Returns the message with options of the command line as arguments: "any_tolerance" for "--any-tolerance".
std::string inPython(const std::string& message);

/// Returns the message about a table of arrays by index: "t[1] = 2" for "torques:3: error: t_s = 2", whose header
/// counts as a line.
std::string byIndex(const std::string& message, const std::string& instants);

/// The number as Python prints it.
inline std::string shown(double number) { return pybind11::repr(pybind11::float_(number)); }

void addComparison(pybind11::module_& module);

using ScenarioClass = pybind11::class_<ScenarioWithSolver, std::shared_ptr<ScenarioWithSolver>>;

void addDerivatives(ScenarioClass& scenario);

/// Adds scenarios from dicts and text, and the reverse.
void addDocuments(pybind11::module_& module, ScenarioClass& scenario);

/// Adds identify() and excite().
void addIdentification(pybind11::module_& module);

/// Adds the functions beside validation: simulate, check, map, compare.
void addStudies(pybind11::module_& module);

void addValidation(pybind11::module_& module);

}  // namespace ursula::python
