#include "python/bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/report.h>
#include <ursula/validate.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "python/archive.h"
#include "python/judging.h"
#include "python/made.h"
#include "python/result_archive.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;

namespace {

py::dict seriesOf(const ValidationResult& result) {
  py::dict out;
  for (std::size_t k = 0; k < result.timeseries.names.size(); ++k) {
    const std::vector<double>& column = result.timeseries.columns[k];
    out[py::str(result.timeseries.names[k])] =
        py::array_t<double>(static_cast<py::ssize_t>(column.size()), column.data());
  }
  return out;
}

[[noreturn]] void refuseFile(const std::string& words) {
  PyErr_SetString(PyExc_OSError, words.c_str());
  throw py::error_already_set();
}

/// Throws Python's OSError with the program's message.
void written(const ValidationResult& result, const std::filesystem::path& dir) {
  if (dir.empty()) refuseFile("cannot write '': an empty path, expected a folder");
  try {
    const Unlocked unlocked;
    writeResults(result, dir);
  } catch (const std::filesystem::filesystem_error& error) {
    refuseFile("cannot write " + dir.string() + ": " + error.code().message());
  } catch (const std::runtime_error& error) {
    refuseFile(error.what());
  }
}

std::optional<ReplayError> replayErrorOf(const ValidationResult& result) {
  const bool any = result.replay_error && result.replay_error->measured;
  return any ? result.replay_error : std::nullopt;
}

void addFindings(py::module_& module) {
  py::class_<Finding> finding(module, "Finding", words::finding);
  addCopies(finding);
  const auto number = [](double Finding::*member) {
    return [member](const Finding& self) {
      return std::isnan(self.*member) ? std::nullopt : std::optional<double>(self.*member);
    };
  };
  finding.def(pickled<Finding>())
      .def_readonly("name", &Finding::name, "The finding's subject.")
      .def_property_readonly("value", number(&Finding::value), "In `unit`; None for a fact that is no number.")
      .def_property_readonly("uncertainty", number(&Finding::uncertainty), "In `unit`; None if it has none.")
      .def_readonly("unit", &Finding::unit, "Empty for a number without one.")
      .def_property_readonly("t", number(&Finding::t), "The instant, s; None if it is of none.")
      .def_property_readonly(
          "leg", [](const Finding& self) { return self.leg > 0 ? std::optional<int>(self.leg) : std::nullopt; },
          "From 1; None if it is of none.")
      .def_property_readonly("text", &textOf, "The fact in words.")
      .def("__repr__", [](const Finding& self) { return "<ursula.Finding " + self.name + ": " + textOf(self) + ">"; });
}

void addDeviation(py::module_& module) {
  using Deviation = EffortDeviation;
  py::class_<Deviation> made(module, "Deviation", words::deviation);
  addCopies(made);
  made.def(pickled<Deviation>())
      .def_readonly("largest", &Deviation::largest, "In `unit`.")
      .def_readonly("unit", &Deviation::unit, "Unit of the efforts: \"N m\", or \"N\" if all motors slide.")
      .def_readonly("t", &Deviation::t, "When, s.")
      .def_readonly("where", &Deviation::where, "The leg or the motor.")
      .def_readonly("largest_effort", &Deviation::largest_effort,
                    "The largest expected effort of the motion, in `unit`.")
      .def_property_readonly("relative", &Deviation::relative, "`largest` over `largest_effort`.")
      .def_property_readonly("smallest_rtol", &Deviation::smallestRelative, "The smallest rtol that would pass alone.")
      .def_readonly("drift", &Deviation::drift,
                    "The distance that such errors may move the platform, m; NaN if unknown.")
      .def_readonly("allowed", &Deviation::allowed,
                    "The deviation that the user's tolerance allows, in `unit`; 0 without a tolerance.")
      .def("__repr__", [](const Deviation& self) {
        return "<ursula.Deviation of " + std::string(py::repr(py::float_(self.largest))) + " " + self.unit + ", " +
               self.where + ">";
      });
}

void addReplayError(py::module_& module) {
  const auto errorOf = [](SourceOfError ReplayError::*source) {
    return [source](const ReplayError& self) { return (self.*source).error; };
  };
  py::class_<ReplayError> made(module, "ReplayError", words::replay_error);
  addCopies(made);
  made.def(pickled<ReplayError>())
      .def_property_readonly(
          "dominant", [](const ReplayError& self) { return ursula::name(self.dominant); },
          "The largest source, by name.")
      .def_readonly("t", &ReplayError::t, "The instant at which the replay deviates most, s.")
      .def_readonly("observed", &ReplayError::observed, "The deviation there, m.")
      .def_property_readonly("rounding", errorOf(&ReplayError::rounding), "Its share, m.")
      .def_property_readonly("integration", errorOf(&ReplayError::integration), "Its share, m.")
      .def_property_readonly("closure", errorOf(&ReplayError::closure), "Its share, m.")
      .def_property_readonly("model", errorOf(&ReplayError::model), "Its share, m.")
      .def_readonly("unexplained", &ReplayError::unexplained, "m.")
      .def_readonly("uncertainty", &ReplayError::uncertainty, "Uncertainty of the sum of the shares, m.")
      .def_readonly("amplification", &ReplayError::amplification, "The factor by which a deviation at the start grows.")
      .def("__repr__", [](const ReplayError& self) {
        return "<ursula.ReplayError of " + std::string(py::repr(py::float_(self.observed))) +
               " m: " + ursula::name(self.dominant) + ">";
      });
}

/// Turns values that do not apply into None: empty text, and 0 for numbers that count from 1.
template <class Value>
std::optional<Value> unlessEmpty(const Value& value) {
  return value == Value{} ? std::nullopt : std::optional(value);
}

/// "<ursula.Cause missing_term gyroscopic of platform>"
std::string shownCause(const NamedCause& cause) {
  std::string out = std::string("<ursula.Cause ") + ursula::name(cause.kind);
  for (const std::string& word : {cause.term, cause.parameter})
    if (!word.empty()) out += " " + word;
  if (cause.parameter.empty() && !cause.body.empty()) out += " of " + cause.body;
  if (cause.parameter.empty() && cause.leg > 0) out += " of leg " + std::to_string(cause.leg);
  if (cause.motor > 0) out += " of motor " + std::to_string(cause.motor);
  return out + ">";
}

void addCause(py::module_& module) {
  py::class_<NamedCause> made(module, "Cause", words::cause);
  addCopies(made);
  made.def(pickled<NamedCause>())
      .def_property_readonly(
          "kind", [](const NamedCause& self) { return ursula::name(self.kind); }, "\"parameter\", \"frame\", …")
      .def_readonly("explained", &NamedCause::explained, "Share of the deviation's square, 0 to 1.")
      .def("__repr__", &shownCause);
  const auto add = [&made](const char* name, auto NamedCause::*member) {
    made.def_property_readonly(name, [member](const NamedCause& self) { return unlessEmpty(self.*member); });
  };
  add("term", &NamedCause::term);
  add("body", &NamedCause::body);
  add("joint", &NamedCause::joint);
  add("parameter", &NamedCause::parameter);
  add("unit", &NamedCause::unit);
  add("leg", &NamedCause::leg);
  add("motor", &NamedCause::motor);
  add("legs", &NamedCause::legs);
  add("signs", &NamedCause::signs);
  made.def_readonly("expected", &NamedCause::expected)
      .def_readonly("found", &NamedCause::found)
      .def_readonly("uncertainty", &NamedCause::uncertainty)
      .def_readonly("from_s", &NamedCause::from_s)
      .def_readonly("to_s", &NamedCause::to_s);
}

std::map<std::string, double> termsOf(const ValidationResult& result) {
  std::map<std::string, double> out;
  for (const TermError& each : result.terms) out[each.term] = each.error;
  return out;
}

void addCheck(py::module_& module) {
  py::class_<Check> check(module, "Check", words::check);
  addCopies(check);
  check.def(pickled<Check>())
      .def_readonly("name", &Check::name, "`group.what`, as in \"torque.pointwise\".")
      .def_readonly("value", &Check::value, "In `unit`.")
      .def_readonly("limit", &Check::limit, "In `unit`.")
      .def_readonly("unit", &Check::unit)
      .def_property_readonly("verdict", &verdictOf<Check>,
                             "\"pass\", \"fail\", \"inconclusive\" or \"not_applicable\".")
      .def_readonly("basis", &Check::basis, "The origin of the limit.")
      .def_property_readonly("why", &whyInFull, "Details of the result: the leg or body, the instant, the size.")
      .def_property_readonly(
          "reason", [](const Check& check) { return ursula::name(check.reason); },
          "The reason why value and limit do not judge it; \"none\" if they do.")
      .def("__repr__",
           [](const Check& check) { return "<ursula.Check " + check.name + ": " + ursula::name(check.verdict) + ">"; });
}

void addResult(py::module_& module) {
  using Result = ValidationResult;
  py::class_<Result> made(module, "Result", words::result);
  addCopies(made);
  made.def(pickled<Result>())
      .def_readonly("scenario", &Result::scenario, "The scenario's name.")
      .def_property_readonly("verdict", &verdictOf<Result>, "\"pass\", \"fail\" or \"inconclusive\".")
      .def_property_readonly(
          "reason", [](const Result& result) { return ursula::reason(result.verdict, result.checks); },
          "The reason for the verdict, in one sentence.")
      .def_property_readonly(
          "checks", [](const Result& result) { return result.checks; }, "All checks, in their order: a list of Check.")
      .def_readonly("findings", &Result::findings, "Facts that are not judged, in their order: a list of Finding.")
      .def_property_readonly(
          "deviation", [](const Result& result) { return result.deviation; },
          "The largest error of the efforts: a Deviation, None if no effort was compared.")
      .def_property_readonly(
          "size",
          [](const Result& result) {
            return result.size ? std::optional<std::string>(ursula::name(result.size->grade)) : std::nullopt;
          },
          "\"rounding\", \"modelling\" or \"wrong\"; None if no effort is wrong.")
      .def_property_readonly(
          "remedy", [](const Result& result) { return ursula::remedyText(result); },
          "A change of the scenario with which the efforts are right, in words; else empty.")
      .def_readonly("cause", &Result::cause, "The likely cause of wrong efforts: a Cause, None if no cause is certain.")
      .def_readonly("causes", &Result::causes, "Other causes that explain the deviation equally well: a list of Cause.")
      .def_readonly("causes_together", &Result::causes_together,
                    "Two or three mistakes that explain the deviation only together, the largest first: a list of "
                    "Cause. `cause` is its first; the list is empty if one mistake does.")
      .def_property_readonly("terms", &termsOf,
                             "Relative errors of the solver's answers to motions with one term at a time.")
      .def_property_readonly("replay_error", &replayErrorOf,
                             "The sources of the replay's deviation: a ReplayError, None without a replay.")
      .def_property_readonly("timeseries", &seriesOf,
                             "The columns of timeseries.csv, each (N,): motion, torques, errors.")
      .def_property_readonly(
          "summary", [](const Result& result) { return fromJson(report::summaryJson(report::stamped(result))); },
          "The contents of summary.json as a dict.")
      .def("write", &written, py::arg("dir"), words::write)
      .def_property_readonly(
          "sentence", [](const Result& result) { return report::sentence(result); },
          "What was found, in the words of the report's head.")
      .def("__str__", [](const Result& result) { return report::validationText(result, false); })
      .def("__repr__", [](const Result& result) {
        return "<ursula.Result " + result.scenario + ": " + ursula::name(result.verdict) + ">";
      });
}

}  // namespace

void addValidation(py::module_& module) {
  addCheck(module);
  addFindings(module);
  addCause(module);
  addDeviation(module);
  addReplayError(module);
  addResult(module);
  addJudging(module);
}

}  // namespace ursula::python
