#pragma once

#include <pybind11/pybind11.h>
#include <ursula/validate.h>

#include <functional>
#include <optional>
#include <string>

#include "python/mechanism.h"
#include "python/scenario.h"
#include "python/signals.h"

namespace ursula::python {

/// Reads torques (N, 6) at instants t (N,) of the machine's own motion. Throws TypeError unless both are given,
/// ValueError for other shapes, and for instants that do not increase or are outside the motion.
TorqueFile torquesAt(const ScenarioWithSolver& given, const pybind11::object& torques, const pybind11::object& t,
                     const std::string& name);

/// Throws ValueError with `name` unless the value is positive.
void requirePositive(const char* name, std::optional<double> value);

/// Returns the result of `run`, which gets the end conditions and does not use Python. Throws the exception of a signal
/// handler.
template <class Run>
auto interruptible(double time_limit, Run&& run) {
  Interruption interruption;
  ValidationOptions options;
  options.time_limit = time_limit;
  options.asked_to_end = [&interruption] { return interruption.cameInBetween(); };
  auto result = [&] {
    const Unlocked unlocked;
    return run(options);
  }();
  interruption.rethrow();
  return result;
}

/// Converts an answer of a user's function to N × width finite numbers, for N instants. Throws ValueError that names
/// the shape expected, or the effort and its instant.
pybind11::array_t<double> answerOf(const pybind11::object& answer, std::size_t instants, pybind11::ssize_t width,
                                   const std::function<double(std::size_t)>& instant);

/// Throws TypeError unless it can be called with what `argument` names.
void refuseUnlessFunction(const pybind11::object& solver, const char* argument);

/// Efforts (N, n) at instants (N,) that a user gave.
struct EffortRows {
  pybind11::array_t<double> t, rows;
  std::size_t count = 0;
};
/// Throws TypeError unless both are given, ValueError for other shapes.
EffortRows effortRows(const pybind11::object& torques, const pybind11::object& t, pybind11::ssize_t width);

/// What validate() is asked beside the scenario.
struct Asked {
  pybind11::object solver, torques, t;
  EffortTolerance tolerance;
  std::string name;  ///< of the solver
  double time_limit = 0;
};
ValidationResult validated(const MechanismWithSolver& given, const Asked& asked);

void addJudging(pybind11::module_& module);

}  // namespace ursula::python
