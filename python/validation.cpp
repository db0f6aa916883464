#include "python/validation.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/report.h>
#include <ursula/validate.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/archive.h"
#include "python/judging.h"
#include "python/result.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;

// Every member is named, so that a new one is a compiler's error here.

static void members(Archive& archive, Largest& largest) {
  auto& [value, t, where] = largest;
  archive(value, t, where);
}

static void members(Archive& archive, Check& check) {
  auto& [name, value, limit, unit, verdict, basis, why, reason, largest, limit_by, missed] = check;
  archive(name, value, limit, unit, verdict, basis, why, reason, largest, limit_by, missed);
}

static void members(Archive& archive, TimeSeries& series) {
  auto& [names, columns] = series;
  archive(names, columns);
}

static void members(Archive& archive, Event& event) {
  auto& [t, what] = event;
  archive(t, what);
}

static void members(Archive& archive, EffortDeviation& deviation) {
  auto& [unit, largest, t, where, largest_effort, drift, duration, length, seen, allowed] = deviation;
  archive(unit, largest, t, where, largest_effort, drift, duration, length, seen, allowed);
}

static void members(Archive& archive, ReplayError& error) {
  auto& [dominant, measured, t, observed, rounding, integration, closure, model, rest, uncertainty, growth] = error;
  archive(dominant, measured, t, observed, rounding, integration, closure, model, rest, uncertainty, growth);
}

static void members(Archive& archive, NamedCause& cause) {
  auto& [kind, term, body, parameter, unit, expected, found, uncertainty, leg, motor, legs, from, to, explained] = cause;
  archive(kind, term, body, parameter, unit, expected, found, uncertainty, leg, motor, legs, from, to, explained);
}

static void members(Archive& archive, TermError& each) {
  auto& [term, error] = each;
  archive(term, error);
}

static void members(Archive& archive, LikelyCause& likely) {
  auto& [off, cause, named, others, terms] = likely;
  archive(off, cause, named, others, terms);
}

/// Read anew from its text.
static void members(Archive& archive, std::shared_ptr<const Scenario>& asked) {
  bool has = asked != nullptr;
  archive(has);
  if (!has) return;
  std::string text, file;
  if (!archive.reads()) {
    text = asked->text;
    file = std::filesystem::absolute(asked->file).string();
  }
  archive(text, file);
  if (archive.reads()) asked = std::make_shared<const Scenario>(parseScenario(text, file));
}

static void members(Archive& archive, ValidationResult& result) {
  auto& [scenario, formulation, limits, verdict, checks, provenance, findings, replay_error, cause, windows, deviation,
         timeseries, curves, events, asked] = result;
  archive(scenario, formulation, limits, verdict, checks, provenance, findings, replay_error, cause, windows, deviation,
          timeseries, curves, events, asked);
}

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

/// Throws Python's OSError in the program's words.
void written(const ValidationResult& result, const std::filesystem::path& dir) {
  if (dir.empty()) refuseFile("cannot write '': an empty path, expected a folder");
  try {
    const py::gil_scoped_release unlocked;
    writeResults(result, dir);
  } catch (const std::filesystem::filesystem_error& error) {
    refuseFile("cannot write " + dir.string() + ": " + error.code().message());
  } catch (const std::runtime_error& error) {
    refuseFile(error.what());
  }
}

/// A fact that is not judged.
struct Finding {
  std::string name, text;
};

std::optional<ReplayError> replayErrorOf(const ValidationResult& result) {
  const bool any = result.replay_error && result.replay_error->measured;
  return any ? result.replay_error : std::nullopt;
}

std::vector<Finding> findingsOf(const ValidationResult& result) {
  std::vector<Finding> out;
  for (const auto& [name, text] : result.findings) out.push_back({name, text});
  return out;
}

void addFindings(py::module_& module) {
  py::class_<Finding> finding(module, "Finding", words::finding);
  addCopies(finding);
  finding
      .def(py::pickle([](const Finding& self) { return py::make_tuple(self.name, self.text); },
                      [](const py::tuple& state) {
                        return Finding{state[0].cast<std::string>(), state[1].cast<std::string>()};
                      }))
      .def_readonly("name", &Finding::name, "What it is about.")
      .def_readonly("text", &Finding::text, "What was found.")
      .def("__repr__", [](const Finding& self) { return "<ursula.Finding " + self.name + ": " + self.text + ">"; });
}

void addDeviation(py::module_& module) {
  using Deviation = EffortDeviation;
  py::class_<Deviation> made(module, "Deviation", words::deviation);
  addCopies(made);
  made.def(pickled<Deviation>())
      .def_readonly("largest", &Deviation::largest, "In `unit`.")
      .def_readonly("unit", &Deviation::unit, "Of the efforts: \"N m\", or \"N\" where all motors slide.")
      .def_readonly("t", &Deviation::t, "When, s.")
      .def_readonly("where", &Deviation::where, "The leg or the motor.")
      .def_readonly("largest_effort", &Deviation::largest_effort, "Of the expected ones along the motion, in `unit`.")
      .def_property_readonly("relative", &Deviation::relative, "To the largest effort.")
      .def_property_readonly("smallest_rtol", &Deviation::smallestRelative, "The smallest rtol that would pass alone.")
      .def_readonly("drift", &Deviation::drift, "How far such errors may move the platform, m; NaN where unknown.")
      .def_readonly("allowed", &Deviation::allowed, "By a tolerance of the user's, in `unit`; 0 where there is none.")
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
      .def_readonly("dominant", &ReplayError::dominant, "The largest source, by name.")
      .def_readonly("t", &ReplayError::t, "Where the replay ended furthest off, s.")
      .def_readonly("observed", &ReplayError::observed, "How far, m.")
      .def_property_readonly("rounding", errorOf(&ReplayError::rounding), "Its share, m.")
      .def_property_readonly("integration", errorOf(&ReplayError::integration), "Its share, m.")
      .def_property_readonly("closure", errorOf(&ReplayError::closure), "Its share, m.")
      .def_property_readonly("model", errorOf(&ReplayError::model), "Its share, m.")
      .def_readonly("unexplained", &ReplayError::unexplained, "m.")
      .def_readonly("uncertainty", &ReplayError::uncertainty, "Of the sum of the shares, m.")
      .def_readonly("amplification", &ReplayError::amplification, "By which a deviation at the start grows.")
      .def("__repr__", [](const ReplayError& self) {
        return "<ursula.ReplayError of " + std::string(py::repr(py::float_(self.observed))) + " m: " + self.dominant +
               ">";
      });
}

void addCheck(py::module_& module) {
  py::class_<Check> check(module, "Check", words::check);
  addCopies(check);
  check.def(pickled<Check>())
      .def_readonly("name", &Check::name, "`group.what`, as in \"torque.pointwise\".")
      .def_readonly("value", &Check::value, "In `unit`.")
      .def_readonly("limit", &Check::limit, "In `unit`.")
      .def_readonly("unit", &Check::unit)
      .def_property_readonly(
          "verdict", [](const Check& check) { return ursula::name(check.verdict); },
          "\"pass\", \"fail\", \"inconclusive\" or \"not_applicable\".")
      .def_readonly("basis", &Check::basis, "Where the limit comes from.")
      .def_readonly("why", &Check::why, "What was found: which leg or body, when, how much.")
      .def_property_readonly(
          "reason", [](const Check& check) { return ursula::name(check.reason); },
          "Why it is not judged by value and limit: \"none\" where it is.")
      .def("__repr__",
           [](const Check& check) { return "<ursula.Check " + check.name + ": " + ursula::name(check.verdict) + ">"; });
}

void addResult(py::module_& module) {
  using Result = ValidationResult;
  py::class_<Result> made(module, "Result", words::result);
  addCopies(made);
  made.def(pickled<Result>())
      .def_readonly("scenario", &Result::scenario, "Its name.")
      .def_property_readonly(
          "verdict", [](const Result& result) { return ursula::name(result.verdict); },
          "\"pass\", \"fail\" or \"inconclusive\".")
      .def_property_readonly(
          "reason", [](const Result& result) { return ursula::reason(result.verdict, result.checks); },
          "The verdict's, in one sentence.")
      .def_property_readonly(
          "checks", [](const Result& result) { return result.checks; }, "All checks, in their order: a list of Check.")
      .def_property_readonly("findings", &findingsOf, "Facts that are not judged, in their order: a list of Finding.")
      .def_property_readonly(
          "deviation", [](const Result& result) { return result.deviation; },
          "How far the efforts are off at most: a Deviation, None where no effort was compared.")
      .def_property_readonly("replay_error", &replayErrorOf,
                             "What moved the replay off the path: a ReplayError, None where there was no replay.")
      .def_property_readonly("timeseries", &seriesOf,
                             "The columns of timeseries.csv, each (N,): motion, torques, errors.")
      .def_property_readonly(
          "summary",
          [](const Result& result) {
            return py::module_::import("json").attr("loads")(report::summaryJson(report::stamped(result)));
          },
          "What summary.json holds, as a dict.")
      .def("write", &written, py::arg("dir"), words::write)
      .def("__repr__", [](const Result& result) {
        return "<ursula.Result " + result.scenario + ": " + ursula::name(result.verdict) + ">";
      });
}

}  // namespace

void addValidation(py::module_& module) {
  addCheck(module);
  addFindings(module);
  addDeviation(module);
  addReplayError(module);
  addResult(module);
  addJudging(module);
}

}  // namespace ursula::python
