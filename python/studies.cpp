#include "python/bindings.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <ursula/report.h>
#include <ursula/studies.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "python/archive.h"
#include "python/judging.h"
#include "python/mechanism.h"
#include "python/motion.h"
#include "python/scenario.h"
#include "python/words.h"

namespace ursula::python {

/// A Simulation in NumPy's terms, for Python.
struct Simulated {
  pybind11::object motion;  ///< a Motion, or a MechanismMotion
  pybind11::array_t<double> tau;
  std::string gave_up;
};

namespace py = pybind11;
namespace {

SimulationEngine engineOf(const std::string& name) {
  if (name == "noc") return SimulationEngine::noc;
  if (name == "simbody") return SimulationEngine::simbody;
  throw py::value_error("engine: '" + name + "', expected 'noc' or 'simbody'");
}

Simulated simulatedMechanism(const MechanismWithSolver& self, const py::object& torques, const py::object& t,
                             SimulationEngine engine, std::optional<double> time_limit) {
  const GivenEfforts given = motorEffortsAt(self, torques, t, "torques");
  MechanismMotion motion;
  MechanismSimulation run;
  try {
    run = interruptible(time_limit.value_or(0), [&](const ValidationOptions& options) {
      const Deadline deadline(options.time_limit, options.asked_to_end);
      MechanismSimulation out = simulateMechanism(self.along(), engine, effortSpline(given), given.t,
                                                  self.scenario.simulation.tolerance, deadline);
      std::vector<MotorMotion> instants;
      for (const MechanismInstant& each : out.instants) instants.push_back(each.motion);
      motion = assemblies(self, instants);
      return out;
    });
  } catch (const CsvError& error) {
    throw py::value_error(inPython(error.what()));
  }
  const auto count = static_cast<py::ssize_t>(run.instants.size());
  py::array_t<double> tau({count, self.motors()});
  for (py::ssize_t k = 0; k < count; ++k)
    Eigen::Map<Eigen::VectorXd>(tau.mutable_data() + k * self.motors(), self.motors()) = run.instants[k].efforts;
  return {py::cast(std::move(motion)), tau, run.gave_up};
}

Simulated simulated(const py::object& s, const py::object& torques, const py::object& t, const std::string& engine,
                    std::optional<double> time_limit) {
  const SimulationEngine chosen = engineOf(engine);
  requirePositive("time_limit", time_limit);
  if (py::isinstance<MechanismWithSolver>(s))
    return simulatedMechanism(s.cast<const MechanismWithSolver&>(), torques, t, chosen, time_limit);
  requireScenario("simulate", s);
  const auto& self = s.cast<const ScenarioWithSolver&>();
  const TorqueFile given = torquesAt(self, torques, t, "torques");
  Simulation run;
  try {
    run = interruptible(time_limit.value_or(0), [&](const ValidationOptions& options) {
      return simulate(self.scenario, chosen, given, Deadline(options.time_limit, options.asked_to_end));
    });
  } catch (const CsvError& error) {
    throw py::value_error(inPython(error.what()));
  }
  const py::array_t<double> tau =
      table(run.torques, motor_count, [](const Vector6d& row, double* to) { Eigen::Map<Vector6d>{to} = row; });
  return {py::cast(Motions{std::move(run.motions)}), tau, run.gave_up};
}

/// Warnings, and what the scenario cannot show as JSON; "null" if this build knows no mistakes.
std::pair<std::vector<std::string>, std::string> foundIn(const py::object& given) {
  const bool is_mechanism = py::isinstance<MechanismWithSolver>(given);
  if (!is_mechanism) requireScenario("check", given);
  const BlindSpotFinder* finder = partBlindSpots();
  const auto blind = [&](auto find, const auto& scenario) {
    return find == nullptr ? std::string("null") : report::blindJsonText(find(scenario));
  };
  if (is_mechanism) {
    const auto& mechanism = given.cast<const MechanismWithSolver&>();
    const Unlocked unlocked;
    return {checked(mechanism), blind(finder == nullptr ? nullptr : finder->mechanism, mechanism.scenario)};
  }
  const auto& self = given.cast<const ScenarioWithSolver&>();
  const Unlocked unlocked;
  tryMotion(self.scenario);
  return {warnings(self.scenario), blind(finder == nullptr ? nullptr : finder->manipulator, self.scenario)};
}

py::object checkedAny(const py::object& given) {
  const auto found = foundIn(given);
  const py::object blind = fromJson(found.second);
  return py::module_::import("ursula._checked").attr("Checked")(found.first, blind);
}

/// Reads None, a number, or (from, to, count), as for the program's option.
GridAxis axisOf(const char* name, const py::object& given) {
  if (given.is_none()) return {};
  std::string text;
  const auto isNumber = [](const py::handle& each) {
    return PyNumber_Check(each.ptr()) != 0 && !py::hasattr(each, "__len__");
  };
  const bool is_sequence = py::isinstance<py::sequence>(given) && !py::isinstance<py::str>(given);
  const py::tuple parts = is_sequence ? py::tuple(given) : py::make_tuple(given);
  if ((is_sequence && parts.size() != 3) || !std::all_of(parts.begin(), parts.end(), isNumber))
    throw py::value_error(std::string(name) + " is " + std::string(py::repr(given)) +
                          ", expected a number or (from, to, count)");
  for (const py::handle part : parts) text += (text.empty() ? "" : ",") + std::string(py::str(part));
  return gridAxis(name, text);
}

/// Returns the rows that the program writes, as columns by name.
py::dict columnsOf(const BlockTable& blocks, int jobs) {
  std::string bytes;
  Interruption interruption;
  {
    const Unlocked unlocked;
    streamBlocks(blocks, {RowFormat::binary, jobs, {}}, [&](std::string_view rows) {
      bytes += rows;
      if (interruption.cameInBetween()) interruption.rethrow();
    });
  }
  const py::dict header = fromJson(bytes.substr(0, bytes.find('\n')));
  const py::list names = header["columns"];
  const auto width = static_cast<py::ssize_t>(names.size());
  const double* first = reinterpret_cast<const double*>(bytes.data() + header["offset"].cast<std::size_t>());
  py::dict out;
  for (py::ssize_t k = 0; k < width; ++k)
    out[names[k]] = py::array_t<double>({static_cast<py::ssize_t>(blocks.rows)},
                                        {width * static_cast<py::ssize_t>(sizeof(double))}, first + k);
  return out;
}

py::dict mapped(const ScenarioWithSolver& self, const py::object& x, const py::object& y, const py::object& z,
                const py::object& roll, const py::object& pitch, const py::object& yaw, double at, int jobs) {
  if (jobs < 0) throw py::value_error("jobs: " + std::to_string(jobs) + ", expected 0 or more");
  const std::array<py::object, grid_axes> given = {x, y, z, roll, pitch, yaw};
  std::array<GridAxis, grid_axes> axes;
  try {
    for (std::size_t k = 0; k < grid_axes; ++k) axes[k] = axisOf(grid_axis_names[k], given[k]);
    const PoseGrid grid(self.scenario, axes, at);
    DrawnMap drawn;
    return columnsOf(mapBlocks(self.scenario, grid, drawn),
                     jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
  } catch (const GridError& error) {
    throw py::value_error(std::regex_replace(error.what(), std::regex("FROM,TO,COUNT"), "(from, to, count)"));
  }
}

}  // namespace

void addStudies(py::module_& module) {
  py::class_<Simulated> simulation(module, "Simulation", words::simulation);
  addCopies(simulation);
  simulation
      .def(py::pickle([](const Simulated& self) { return py::make_tuple(self.motion, self.tau, self.gave_up); },
                      [](const py::tuple& state) {
                        return Simulated{state[0].cast<py::object>(), state[1].cast<py::array_t<double>>(),
                                         state[2].cast<std::string>()};
                      }))
      .def_readonly("motion", &Simulated::motion,
                    "Motion of the platform, or of a mechanism's motors, at the instants reached.")
      .def_readonly("tau", &Simulated::tau, "Efforts at the same instants, N m or N: (N, 6), or (N, n).")
      .def_property_readonly(
          "gave_up",
          [](const Simulated& self) { return self.gave_up.empty() ? py::object(py::none()) : py::str(self.gave_up); },
          "The reason why the last instant was not reached; None if it was.")
      .def("__repr__", [](const Simulated& self) {
        return "<ursula.Simulation of " + std::to_string(py::len(self.motion)) + " instants" +
               (self.gave_up.empty() ? "" : ", gave up") + ">";
      });
  module.def("simulate", &simulated, py::arg("s"), py::arg("torques"), py::arg("t"), py::kw_only(),
             py::arg("engine") = "simbody", py::arg("time_limit") = py::none(), words::simulate);
  module.def("check", &checkedAny, py::arg("s"), words::check_scenario);
  module.def("map", &mapped, py::arg("s"), py::kw_only(), py::arg("x") = py::none(), py::arg("y") = py::none(),
             py::arg("z") = py::none(), py::arg("roll") = py::none(), py::arg("pitch") = py::none(),
             py::arg("yaw") = py::none(), py::arg("at") = 0.0, py::arg("jobs") = 0, words::map);
  addComparison(module);
  addIdentification(module);
}

}  // namespace ursula::python
