#include "python/judging.h"

#include <pybind11/stl.h>
#include <ursula/validate.h>

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "python/bindings.h"
#include "python/motion.h"
#include "python/result.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

std::string atInstant(const Motion<double>& motion) { return " at t = " + shown(motion.t) + " s"; }

std::string typeOf(const py::object& value) { return py::str(py::type::of(value).attr("__name__")); }

/// Checks that the solver's answer to `motions` has N × 6 finite numbers.
std::vector<Vector6d> torquesOf(const py::object& answer, const std::vector<Motion<double>>& motions) {
  const py::array any = numbersIn(answer, "the solver's answer" + atInstant(motions.front()) + " is of type " +
                                              typeOf(answer) + ", expected an array of real numbers");
  if (any.ndim() != 2 || static_cast<std::size_t>(any.shape(0)) != motions.size() || any.shape(1) != motor_count)
    throw py::value_error("the solver's answer to " + std::to_string(motions.size()) + " instants has shape " +
                          std::string(py::str(any.attr("shape"))) + ", expected (" + std::to_string(motions.size()) +
                          ", 6)");
  const py::array_t<double, py::array::c_style | py::array::forcecast> given(any);  // comes last, because it may copy
  std::vector<Vector6d> out;
  out.reserve(motions.size());
  for (std::size_t k = 0; k < motions.size(); ++k) {
    out.emplace_back(Eigen::Map<const Vector6d>(given.data() + motor_count * k));
    for (int i = 0; i < motor_count; ++i)
      if (!std::isfinite(out.back()(i)))
        throw py::value_error("the solver's effort " + std::to_string(i + 1) + atInstant(motions[k]) + " is " +
                              shown(out.back()(i)) + ", expected a finite number");
  }
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

void refuseUnlessFunction(const py::object& solver) {
  if (PyCallable_Check(solver.ptr()) != 0) return;
  const bool is_text = py::isinstance<py::str>(solver);
  throw py::type_error("validate: solver is " + (is_text ? std::string(py::repr(solver)) + " " : std::string()) +
                       "of type " + typeOf(solver) + ", expected a function of a Motion" +
                       (is_text ? "; a command is for `ursula validate` in a terminal" : ""));
}

/// Validates a user's function.
ValidationResult ofSolver(const Scenario& scenario, const py::object& solver, std::string name, double limit) {
  refuseUnlessFunction(solver);
  OutsideSolver outside;
  outside.name = std::move(name);
  // By reference, because copies are made without the lock.
  outside.torques = [&solver](const std::vector<Motion<double>>& motions) {
    const Locked locked;
    const py::object given = py::cast(Motions{motions});
    PyObject* answer = called(solver.ptr(), given.ptr());
    if (answer == nullptr) throw py::error_already_set();
    return torquesOf(py::reinterpret_steal<py::object>(answer), motions);
  };
  return interruptible(limit,
                       [&](const ValidationOptions& options) { return validateOutside(scenario, outside, options); });
}

/// Validates a user's numbers.
ValidationResult ofTorques(const Scenario& scenario, const TorqueFile& torques, double limit) {
  return interruptible(limit, [&](const ValidationOptions& options) {
    return validateExternal(scenario, torques, options.time_limit, options.asked_to_end, options.threads);
  });
}

ValidationResult validated(const ScenarioWithSolver& given, const py::object& solver, const py::object& torques,
                           const py::object& t, const Share& share, std::optional<double> atol, const py::object& name,
                           bool any_tolerance, std::optional<double> time_limit) {
  const std::optional<double> rtol = shareOf("rtol", share);
  requirePositive("rtol", rtol);
  requirePositive("atol", atol);
  Scenario scenario = given.scenario;
  setTolerance({rtol.value_or(0), atol.value_or(0), any_tolerance}, scenario);
  requirePositive("time_limit", time_limit);
  const double limit = time_limit.value_or(0);
  if (!solver.is_none() && !torques.is_none())
    throw py::type_error("validate: solver and torques are given, expected one of them");
  const auto called = [&name](const std::string& otherwise) {
    return name.is_none() ? otherwise : std::string(py::str(name));
  };
  if (!torques.is_none() || !t.is_none())
    return ofTorques(scenario, torquesAt(given, torques, t, called("torques")), limit);
  if (!solver.is_none()) return ofSolver(scenario, solver, called(nameOf(solver)), limit);
  return interruptible(limit, [&](const ValidationOptions& options) { return validate(scenario, options); });
}

}  // namespace

TorqueFile torquesAt(const ScenarioWithSolver& given, const py::object& torques, const py::object& t,
                     const std::string& name) {
  if (torques.is_none() || t.is_none())
    throw py::type_error(torques.is_none() ? "t is given without torques, expected both"
                                           : "torques are given without t, expected both: their instants, s");
  const py::array_t<double> instants = columnOf(t, "t"), rows = rowsOf(torques, motor_count, "torques");
  const auto count = static_cast<std::size_t>(instants.shape(0));
  if (rows.shape(0) != instants.shape(0))
    throw py::value_error("torques: " + std::to_string(rows.shape(0)) + " rows, expected one for each of the " +
                          std::to_string(count) + " instants t");
  if (count == 0) throw py::value_error("torques: no rows, expected at least one");
  GivenTorques table{name, {instants.data(), instants.data() + count}, {}};
  for (std::size_t k = 0; k < count; ++k)
    table.torques.emplace_back(Eigen::Map<const Vector6d>(rows.data() + motor_count * k));
  try {
    return within(torqueFileOf(table, given.scenario.manipulator->motors()), given.scenario.trajectory->duration());
  } catch (const CsvError& error) {
    throw py::value_error(byIndex(error.what(), "t"));
  }
}

void requirePositive(const char* name, std::optional<double> value) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw py::value_error(std::string(name) + " is " + shown(*value) + ", expected a positive number");
}

void addJudging(py::module_& module) {
  module.def("validate", &validated, py::arg("s"), py::arg("solver") = py::none(), py::kw_only(),
             py::arg("torques") = py::none(), py::arg("t") = py::none(), py::arg("rtol") = py::none(),
             py::arg("atol") = py::none(), py::arg("name") = py::none(), py::arg("any_tolerance") = false,
             py::arg("time_limit") = py::none(), words::validate);
}

}  // namespace ursula::python
