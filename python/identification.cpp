#include "python/bindings.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <ursula/identify.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "python/scenario.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

py::dict columnsOf(const TimeSeries& series) {
  py::dict out;
  for (std::size_t k = 0; k < series.names.size(); ++k)
    out[py::str(series.names[k])] =
        py::array_t<double>(static_cast<py::ssize_t>(series.columns[k].size()), series.columns[k].data());
  return out;
}

/// Returns the parts of Python's Identified: summary as JSON, page, table, identified scenario, efforts and spectra by
/// column.
template <class Log>
py::tuple identified(const ScenarioWithSolver& self, const Log& log, bool prior) {
  IdentifyResult result;
  std::string summary, page, table;
  try {
    const Unlocked unlocked;
    IdentifyOptions options;
    options.prior = prior;
    result = identify(self.scenario, log(), options);
    summary = identifySummary(result);
    page = identifyPage(result);
    table = identifyTable(result);
  } catch (const CsvError& error) {
    throw py::value_error(inPython(error.what()));
  }
  return py::make_tuple(summary, page, table, result.identified_scenario, columnsOf(result.series),
                        columnsOf(result.spectra));
}

py::tuple ofFile(const ScenarioWithSolver& self, const std::string& file, const std::vector<std::string>& map,
                 const std::vector<double>& constants, bool prior) {
  return identified(
      self,
      [&] {
        return readMeasuredLog({file, map, constants}, *self.scenario.manipulator);
      },
      prior);
}

py::tuple ofArrays(const ScenarioWithSolver& self, const std::vector<double>& t, const Eigen::MatrixXd& motion,
                   const Eigen::MatrixXd& efforts, bool prior) {
  if (motion.rows() != static_cast<Eigen::Index>(t.size()) || efforts.rows() != motion.rows() ||
      efforts.cols() != motor_count || (motion.cols() != motor_count && motion.cols() != 7))
    throw py::value_error("expected t (N,), motion (N, 6) of driven coordinates or (N, 7) of p and q, efforts (N, 6)");
  return identified(
      self, [&] { return measuredLogOf(t, motion, efforts, *self.scenario.manipulator); }, prior);
}

std::string excited(const ScenarioWithSolver& self, double period, int harmonics, int tries, std::int64_t seed) {
  if (!(period >= 0 && std::isfinite(period)) || harmonics < 1 || tries < 1 || seed < 0)
    throw py::value_error("excite: expected a period and a seed of 0 or more, harmonics and tries of 1 or more");
  const Unlocked unlocked;
  ExciteOptions options;
  options.period = period;
  options.harmonics = harmonics;
  options.tries = tries;
  options.seed = static_cast<std::uint64_t>(seed);
  return excite(self.scenario, options).csv;
}

}  // namespace

void addIdentification(py::module_& module) {
  module.def("_identify_file", &ofFile);
  module.def("_identify_arrays", &ofArrays);
  module.def(
      "excite", &excited, py::arg("s"), py::kw_only(), py::arg("period") = 0.0, py::arg("harmonics") = 5,
      py::arg("tries") = 600, py::arg("seed") = 1,
      "A periodic motion that shows the machine's numbers, as the text of a samples file (CSV): t_s, p_x_m ... q_z.\n\n"
      "period in s; 0 for the scenario's duration, at least 4 s. Raises RuntimeError where no motion keeps to the "
      "limits.");
}

}  // namespace ursula::python
