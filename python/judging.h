#pragma once

#include <pybind11/pybind11.h>
#include <ursula/validate.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

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

/// What validate() is asked beside the scenario.
struct Asked {
  pybind11::object solver, torques, t, accelerations;
  EffortTolerance tolerance;
  std::string name;  ///< of the solver
  double time_limit = 0;
  bool thorough = false, quick = false;
  pybind11::object progress = pybind11::none();  ///< a function of the share done and of what is done now, or None
};

/// Calls a user's function, and keeps its exception until the work has ended.
class Telling {
 public:
  explicit Telling(const pybind11::object& function) : function_(function) {}
  void at(double share, const char* now);
  bool hasRaised() const { return raised_.has_value(); }
  void rethrow() const {
    if (raised_) throw *raised_;
  }

 private:
  const pybind11::object& function_;
  std::optional<pybind11::error_already_set> raised_;
};

/// Returns the result of `run`, which gets the end conditions and does not use Python. Throws the exception of a signal
/// handler.
template <class Run>
auto interruptible(const Asked& asked, Run&& run) {
  Interruption interruption;
  Telling telling(asked.progress);
  ValidationOptions options;
  options.time_limit = asked.time_limit;
  options.thorough = asked.thorough;
  options.quick = asked.quick;
  options.asked_to_end = [&] { return telling.hasRaised() || interruption.cameInBetween(); };
  if (!asked.progress.is_none())
    options.progress = [&telling](double share, const char* now) { telling.at(share, now); };
  auto result = [&] {
    const Unlocked unlocked;
    return run(options);
  }();
  interruption.rethrow();
  telling.rethrow();
  return result;
}

template <class Run>
auto interruptible(double time_limit, Run&& run) {
  Asked asked;
  asked.time_limit = time_limit;
  return interruptible(asked, std::forward<Run>(run));
}

/// Converts an answer of a user's function to N × width finite numbers, for N instants. Throws ValueError that names
/// the shape expected, or the effort and its instant.
pybind11::array_t<double> answerOf(const pybind11::object& answer, std::size_t instants, pybind11::ssize_t width,
                                   const std::function<double(std::size_t)>& instant, const char* whose = "solver",
                                   const char* what = "effort");

/// Throws TypeError unless it can be called with what `argument` names.
void refuseUnlessFunction(const pybind11::object& function, const char* argument, const char* name = "solver");

/// Efforts (N, n) at instants (N,) that a user gave.
struct EffortRows {
  pybind11::array_t<double> t, rows;
  std::size_t count = 0;
};
/// Throws TypeError unless both are given, ValueError for other shapes.
EffortRows effortRows(const pybind11::object& torques, const pybind11::object& t, pybind11::ssize_t width);

/// Takes efforts (N, n) at instants, s, for a mechanism. Throws ValueError.
GivenEfforts motorEffortsAt(const MechanismWithSolver& given, const pybind11::object& torques,
                            const pybind11::object& t, const std::string& name);

ValidationResult validated(const MechanismWithSolver& given, const Asked& asked);

void addJudging(pybind11::module_& module);

}  // namespace ursula::python
