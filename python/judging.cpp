#include "python/judging.h"

#include <pybind11/stl.h>
#include <ursula/studies.h>
#include <ursula/validate.h>

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "python/bindings.h"
#include "python/made.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

/// Checks that the solver's answer to `motions` has N × 6 finite numbers.
std::vector<Vector6d> torquesOf(const py::object& answer, const std::vector<Motion<double>>& motions) {
  const auto instant = [&motions](std::size_t k) { return motions[k].t; };
  const py::array_t<double> given = answerOf(answer, motions.size(), motor_count, instant);
  std::vector<Vector6d> out;
  out.reserve(motions.size());
  for (std::size_t k = 0; k < motions.size(); ++k)
    out.emplace_back(Eigen::Map<const Vector6d>(given.data() + motor_count * k));
  return out;
}

/// "solve" of "outer.<locals>.solve"; "your function" for a lambda.
std::string nameOf(const py::object& solver) {
  static const std::string around = "<locals>.";
  const std::string whole = py::str(py::getattr(solver, "__qualname__", py::type::of(solver).attr("__name__")));
  const std::size_t at = whole.rfind(around);
  const std::string own = at == std::string::npos ? whole : whole.substr(at + around.size());
  return own == "<lambda>" ? "your function" : own;
}

/// A number, or its text, also as "0.1%".
using Share = std::optional<std::variant<double, std::string>>;

std::optional<double> shareOf(const char* name, const Share& given) {
  if (!given || std::holds_alternative<double>(*given))
    return given ? std::optional(std::get<double>(*given)) : std::nullopt;
  const std::string& text = std::get<std::string>(*given);
  if (const std::optional<double> share = percentage(text)) return share;
  const LeadingNumber number = leadingNumber(text);
  if (number.length > 0 && number.length == text.size()) return number.value;
  throw py::value_error(std::string(name) + " is '" + text + "', expected a number or a share such as '0.1%'");
}

/// Validates a user's function.
ValidationResult ofSolver(const Scenario& scenario, const Asked& asked) {
  const py::object& solver = asked.solver;
  refuseUnlessFunction(solver, "a Motion");
  OutsideSolver outside;
  outside.name = asked.name;
  // By reference, because copies are made without the lock.
  outside.torques = [&solver](const std::vector<Motion<double>>& motions) {
    const Locked locked;
    const py::object given = py::cast(Motions{motions});
    PyObject* answer = called(solver.ptr(), given.ptr());
    if (answer == nullptr) throw py::error_already_set();
    return torquesOf(py::reinterpret_steal<py::object>(answer), motions);
  };
  return interruptible(asked,
                       [&](const ValidationOptions& options) { return validateOutside(scenario, outside, options); });
}

/// Converts a simulator's answer, a pair of linear and angular accelerations (N, 3).
std::vector<Vector6d> accelerationsOf(const py::object& answer, const std::vector<Motion<double>>& states) {
  const auto instant = [&states](std::size_t k) { return states[k].t; };
  if (!py::isinstance<py::sequence>(answer) || py::len(answer) != 2)
    throw py::value_error("the simulator's answer is of type " + typeOf(answer) +
                          ", expected a pair (a, alpha), each (N, 3)");
  const py::sequence pair(answer);
  const py::array_t<double> linear = answerOf(pair[0], states.size(), 3, instant, "simulator", "acceleration"),
                            angular = answerOf(pair[1], states.size(), 3, instant, "simulator", "acceleration");
  std::vector<Vector6d> out(states.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    out[k] << Eigen::Map<const Vector3d>(angular.data() + 3 * k), Eigen::Map<const Vector3d>(linear.data() + 3 * k);
  return out;
}

/// Validates a user's direct dynamics.
ValidationResult ofSimulator(const Scenario& scenario, const Asked& asked) {
  refuseUnlessFunction(asked.accelerations, "a Motion and efforts", "accelerations");
  OutsideSimulator outside;
  outside.name = asked.name;
  outside.accelerations = [&asked](const std::vector<Motion<double>>& states, const std::vector<Vector6d>& efforts) {
    const Locked locked;
    py::array_t<double> rows({static_cast<py::ssize_t>(efforts.size()), py::ssize_t{motor_count}});
    for (std::size_t k = 0; k < efforts.size(); ++k)
      Eigen::Map<Vector6d>(rows.mutable_data() + motor_count * k) = efforts[k];
    return accelerationsOf(asked.accelerations(py::cast(Motions{states}), rows), states);
  };
  return interruptible(asked,
                       [&](const ValidationOptions& options) { return validateSimulator(scenario, outside, options); });
}

/// Validates a user's numbers.
ValidationResult ofTorques(const Scenario& scenario, const TorqueFile& torques, const Asked& asked) {
  return interruptible(asked, [&](const ValidationOptions& options) {
    return validateExternal(scenario, torques, options.time_limit, options.asked_to_end, options.threads);
  });
}

ValidationResult validated(const ScenarioWithSolver& given, const Asked& asked) {
  Scenario scenario = given.scenario;
  setTolerance(asked.tolerance, scenario);
  if (!asked.torques.is_none() || !asked.t.is_none())
    return ofTorques(scenario, torquesAt(given, asked.torques, asked.t, asked.name), asked);
  if (!asked.solver.is_none()) return ofSolver(scenario, asked);
  if (!asked.accelerations.is_none()) return ofSimulator(scenario, asked);
  return interruptible(asked, [&](const ValidationOptions& options) { return validate(scenario, options); });
}

/// Reads the file if a path is given.
py::object scenarioOf(const py::object& given) {
  if (!py::isinstance<py::str>(given) && !py::hasattr(given, "__fspath__")) return given;
  return py::module_::import("ursula").attr("read_scenario")(given);
}

ValidationResult validatedAny(const py::object& s, const py::object& solver, const py::object& torques,
                              const py::object& t, const Share& share, std::optional<double> atol,
                              const py::object& name, bool any_tolerance, std::optional<double> time_limit,
                              bool thorough, bool quick, const py::object& progress, const py::object& accelerations) {
  const std::optional<double> rtol = shareOf("rtol", share);
  requirePositive("rtol", rtol);
  requirePositive("atol", atol);
  requirePositive("time_limit", time_limit);
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("validate: progress is of type " + typeOf(progress) +
                         ", expected a function of a share from 0 to 1 and a text");
  if (thorough && quick) throw py::type_error("validate: thorough and quick are given, expected one of them");
  if (!solver.is_none() && !torques.is_none())
    throw py::type_error("validate: solver and torques are given, expected one of them");
  if (!accelerations.is_none() && !(solver.is_none() && torques.is_none()))
    throw py::type_error("validate: accelerations and solver or torques are given, expected one of them");
  const std::string own =
      torques.is_none() && t.is_none() ? nameOf(accelerations.is_none() ? solver : accelerations) : "torques";
  const Asked asked = {solver,
                       torques,
                       t,
                       accelerations,
                       {rtol.value_or(0), atol.value_or(0), any_tolerance},
                       name.is_none() ? own : std::string(py::str(name)),
                       time_limit.value_or(0),
                       thorough,
                       quick,
                       progress};
  const py::object given = scenarioOf(s);
  const bool is_mechanism = py::isinstance<MechanismWithSolver>(given);
  if (!is_mechanism) requireScenario("validate", given, "ursula.Scenario, ursula.MechanismScenario or a path");
  ValidationResult result = is_mechanism ? validated(given.cast<const MechanismWithSolver&>(), asked)
                                         : validated(given.cast<const ScenarioWithSolver&>(), asked);
  const BlindSpotFinder* finder = partBlindSpots();
  if (finder == nullptr) return result;
  if (is_mechanism) {
    MechanismScenario judged = given.cast<const MechanismWithSolver&>().scenario;
    setTolerance(asked.tolerance, judged.tolerance);
    result.blind = finder->mechanism(judged);
  } else {
    Scenario judged = given.cast<const ScenarioWithSolver&>().scenario;
    setTolerance(asked.tolerance, judged);
    result.blind = finder->manipulator(judged);
  }
  return result;
}

}  // namespace

TorqueFile torquesAt(const ScenarioWithSolver& given, const py::object& torques, const py::object& t,
                     const std::string& name) {
  const auto [instants, rows, count] = effortRows(torques, t, motor_count);
  GivenTorques table{name, {instants.data(), instants.data() + count}, {}};
  for (std::size_t k = 0; k < count; ++k)
    table.torques.emplace_back(Eigen::Map<const Vector6d>(rows.data() + motor_count * k));
  try {
    return within(torqueFileOf(table, given.scenario.manipulator->motors()), given.scenario.trajectory->duration());
  } catch (const CsvError& error) {
    throw py::value_error(byIndex(error.what(), "t"));
  }
}

void requireScenario(const char* function, const py::object& given, const char* expected) {
  if (py::isinstance<ScenarioWithSolver>(given)) return;
  const std::string text = py::repr(given), type = typeOf(given);
  throw py::type_error(std::string(function) + ": s is " +
                       (given.is_none() ? text : (text.size() < 60 ? text : "a value") + " of type " + type) +
                       ", expected " + expected);
}

void Telling::at(double share, const char* now) {
  if (raised_) return;
  const Locked locked;
  try {
    function_(share, now);
  } catch (const py::error_already_set& error) {
    raised_.emplace(error);
  }
}

void requirePositive(const char* name, std::optional<double> value) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw py::value_error(std::string(name) + " is " + shown(*value) + ", expected a positive number");
}

void addJudging(py::module_& module) {
  module.def("validate", &validatedAny, py::arg("s"), py::arg("solver") = py::none(), py::kw_only(),
             py::arg("torques") = py::none(), py::arg("t") = py::none(), py::arg("rtol") = py::none(),
             py::arg("atol") = py::none(), py::arg("name") = py::none(), py::arg("any_tolerance") = false,
             py::arg("time_limit") = py::none(), py::arg("thorough") = false, py::arg("quick") = false,
             py::arg("progress") = py::none(), py::arg("accelerations") = py::none(), words::validate);
}

}  // namespace ursula::python
