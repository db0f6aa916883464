#pragma once

#include <pybind11/pybind11.h>
#include <ursula/validate.h>

#include <optional>
#include <string>

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

void addJudging(pybind11::module_& module);

}  // namespace ursula::python
