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

template <class Pairs>
py::dict dictOf(const Pairs& pairs) {
  py::dict out;
  for (const auto& [key, value] : pairs) out[py::str(key)] = value;
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
      .def_property_readonly(
          "findings", [](const Result& result) { return dictOf(result.findings); }, "Facts that are not judged.")
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
  addResult(module);
  addJudging(module);
}

}  // namespace ursula::python
