#include "python/bindings.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/studies.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "python/made.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

/// Reads the columns of a dict, each (N,); like those of a file, they may contain NaN.
TimeSeries seriesIn(const py::dict& columns, const std::string& what) {
  if (!columns.contains("t_s")) throw py::value_error(what + ": no 't_s', expected the instants, s");
  CsvTable out;
  out.file = what;
  for (const auto& [key, values] : columns) {
    const std::string name = py::str(key);
    const py::array_t<double, py::array::c_style | py::array::forcecast> column(
        numbersIn(py::reinterpret_borrow<py::object>(values), what + "['" + name + "']: expected real numbers"));
    if (column.ndim() != 1 ||
        (!out.columns.empty() && static_cast<std::size_t>(column.size()) != out.columns[0].size()))
      throw py::value_error(what + "['" + name + "']: shape " + std::string(py::str(column.attr("shape"))) +
                            ", expected (N,), the same N for each column");
    out.names.push_back(name);
    out.columns.emplace_back(column.data(), column.data() + column.size());
  }
  const std::size_t rows = out.columns.empty() ? 0 : out.columns[0].size();
  for (std::size_t k = 0; k < rows; ++k) out.lines.push_back(static_cast<int>(k) + 2);  // as below a header
  try {
    return historyOf(out);
  } catch (const CsvError& error) {
    throw py::value_error(byIndex(error.what(), what + "['t_s']"));
  }
}

TimeSeries historyFrom(const py::object& given, const std::string& what) {
  if (py::isinstance<ValidationResult>(given)) return given.cast<const ValidationResult&>().timeseries;
  if (py::isinstance<py::dict>(given)) return seriesIn(given, what);
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
    return readHistory(given.cast<std::filesystem::path>());
  throw py::type_error(what + ": expected a Result, a dict of arrays, or the path of a CSV or of a result folder");
}

Comparison compared(const py::object& reference, const py::object& test, double tolerance, double time_tolerance,
                    std::optional<bool> interpolate, const std::vector<std::string>& columns) {
  for (const auto& [name, value] : {std::pair("tolerance", tolerance), {"time_tolerance", time_tolerance}})
    if (!(value >= 0 && std::isfinite(value)))
      throw py::value_error(std::string(name) + " is " + shown(value) + ", expected 0 or a positive number");
  try {
    const TimeSeries before = historyFrom(reference, "reference"), after = historyFrom(test, "test");
    const Unlocked unlocked;
    return compare(before, after, {tolerance, time_tolerance, interpolate, columns});
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const py::error_already_set&) {
    throw;
  } catch (const std::exception& error) {  // from a file, or from a column's name
    throw py::value_error(inPython(error.what()));
  }
}

void addChannel(py::module_& module) {
  using Channel = ChannelComparison;
  py::class_<Channel>(module, "Channel", "One channel of a comparison.")
      .def_readonly("name", &Channel::name, "The column's name.")
      .def_readonly("scale", &Channel::scale, "Largest magnitude in its group, as of all tau_*, in its unit.")
      .def_readonly("tolerance", &Channel::tolerance, "In its unit.")
      .def_readonly("max_error", &Channel::max_error, "In its unit.")
      .def_readonly("max_at", &Channel::max_at, "When, s.")
      .def_readonly("rms_error", &Channel::rms_error)
      .def_readonly("final_error", &Channel::final_error)
      .def_readonly("outside", &Channel::outside, "The largest distance beyond the tube around the reference.")
      .def_readonly("interpolation", &Channel::interpolation, "The largest error of interpolating the reference.")
      .def_property_readonly("verdict", &verdictOf<Channel>, "\"pass\", \"fail\" or \"inconclusive\".")
      .def("__repr__", [](const Channel& self) {
        return "<ursula.Channel " + self.name + ": " + ursula::name(self.verdict) + ">";
      });
}

}  // namespace

void addComparison(py::module_& module) {
  addChannel(module);
  py::class_<Comparison>(module, "Comparison", words::comparison)
      .def_property_readonly("verdict", &verdictOf<Comparison>, "\"pass\", \"fail\" or \"inconclusive\".")
      .def_property_readonly(
          "channels", [](const Comparison& self) { return self.channels; },
          "The channels that both have, in the reference's order: a list of Channel.")
      .def_readonly("only_in_reference", &Comparison::only_in_reference, "Names of channels.")
      .def_readonly("only_in_test", &Comparison::only_in_test, "Names of channels.")
      .def_readonly("instants", &Comparison::instants, "Number of the test's instants that were compared.")
      .def_readonly("interpolated", &Comparison::interpolated,
                    "Number of them that lie between two instants of the reference.")
      .def_readonly("left_out", &Comparison::left_out,
                    "Number of the test's instants that the reference does not cover.")
      .def_readonly("skipped", &Comparison::skipped, "Number of the reference's instants in gaps of the test.")
      .def("__str__", [](const Comparison& self) { return comparisonText(self); })
      .def("__repr__", [](const Comparison& self) {
        return "<ursula.Comparison of " + std::to_string(self.channels.size()) +
               " channels: " + ursula::name(self.verdict) + ">";
      });
  module.def("compare", &compared, py::arg("reference"), py::arg("test"), py::kw_only(),
             py::arg("tolerance") = CompareOptions().tolerance, py::arg("time_tolerance") = 0.0,
             py::arg("interpolate") = py::none(), py::arg("columns") = std::vector<std::string>(), words::compare);
}

}  // namespace ursula::python
