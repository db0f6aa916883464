#include "python/scenario.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/studies.h>
#include <ursula/validate.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/archive.h"
#include "python/bindings.h"
#include "python/machine_numbers.h"
#include "python/mechanism.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

Motions motionAt(const ScenarioWithSolver& self, const py::object& t) {
  const py::array_t<double> instants = columnOf(t, "t");
  const Trajectory& trajectory = *self.scenario.trajectory;
  const double duration = trajectory.duration();
  refuseOutside(instants, duration);
  const double* data = instants.data();
  const std::size_t count = instants.shape(0);
  Motions out;
  const Unlocked unlocked;
  out.rows.reserve(count);
  forRows(count, [&](std::size_t k) {
    out.rows.push_back(trajectory.at(std::clamp(data[k], 0.0, duration)));
    requireFinite(out.rows.back());
  });
  return out;
}

/// Answers block by block with `all`. For a flagged pose it calls one(k), which throws the program's error.
template <class All, class One, class Put>
void answers(const ScenarioWithSolver& self, const Motions& motion, All&& all, One&& one, Put&& put) {
  const Unlocked unlocked;
  const Load* load = self.scenario.load.get();
  std::vector<Vector6d> loads, out;
  std::vector<PoseFault> faults;
  inBlocks(motion.rows.size(), batch_at_once, [&](std::size_t first, std::size_t last) {
    loads.clear();
    for (std::size_t k = first; k < last; ++k) loads.push_back(loadAtP(load, motion.rows[k]));
    out.resize(loads.size());
    faults.assign(loads.size(), PoseFault::none);
    all(first, loads.size(), load == nullptr ? nullptr : loads.data(), out.data(), faults.data());
    for (std::size_t k = 0; k < out.size(); ++k)
      put(first + k, faults[k] == PoseFault::none ? out[k] : one(first + k, loads[k]));
  });
}

/// Creates an N × width array to be filled.
py::array_t<double> rowsFor(const Motions& motion, py::ssize_t width) {
  return py::array_t<double>({static_cast<py::ssize_t>(motion.rows.size()), width});
}

void refuseJobs(int jobs) {
  if (jobs < 0) throw py::value_error("jobs: " + std::to_string(jobs) + ", expected 0 or more");
}

py::array_t<double> inverseDynamics(const ScenarioWithSolver& self, const Motions& motion, int jobs) {
  refuseJobs(jobs);
  py::array_t<double> efforts = rowsFor(motion, motor_count);
  double* to = efforts.mutable_data();
  Workspace<double> work;
  answers(
      self, motion,
      [&](std::size_t first, std::size_t count, const Vector6d* loads, Vector6d* out, PoseFault* faults) {
        ursula::inverseDynamics(self.batch, motion.rows.data() + first, count, out, faults, loads, jobs);
      },
      [&](std::size_t k, const Vector6d& load) {
        return self.kinematics.solver().inverseDynamics(motion.rows[k], work, load);
      },
      [&](std::size_t k, const Vector6d& tau) { Eigen::Map<Vector6d>(to + motor_count * k) = tau; });
  return efforts;
}

py::tuple forwardDynamics(const ScenarioWithSolver& self, const Motions& motion, const py::object& tau, int jobs) {
  refuseJobs(jobs);
  const py::array_t<double> given = rowsOf(tau, motor_count, "tau");
  if (static_cast<std::size_t>(given.shape(0)) != motion.rows.size())
    throw py::value_error("tau: " + std::to_string(given.shape(0)) + " rows, expected one for each of the motion's " +
                          std::to_string(motion.rows.size()));
  py::array_t<double> a = rowsFor(motion, 3), alpha = rowsFor(motion, 3);
  double *to_a = a.mutable_data(), *to_alpha = alpha.mutable_data();
  const auto effort = [from = given.data()](std::size_t k) {
    return Vector6d(Eigen::Map<const Vector6d>(from + motor_count * k));
  };
  std::vector<Vector6d> efforts;
  Workspace<double> work;
  answers(
      self, motion,
      [&](std::size_t first, std::size_t count, const Vector6d* loads, Vector6d* out, PoseFault* faults) {
        efforts.clear();
        for (std::size_t k = 0; k < count; ++k) efforts.push_back(effort(first + k));
        ursula::directDynamics(self.batch, motion.rows.data() + first, efforts.data(), count, out, faults, loads, jobs);
      },
      [&](std::size_t k, const Vector6d& load) {
        return self.kinematics.solver().directDynamics(motion.rows[k], effort(k), work, load);
      },
      [&](std::size_t k, const Vector6d& rate) {
        Eigen::Map<Vector3d>(to_alpha + 3 * k) = rate.head<3>();
        Eigen::Map<Vector3d>(to_a + 3 * k) = rate.tail<3>();
      });
  return py::make_tuple(a, alpha);
}

bool has(const Leg& leg, Coordinate coordinate) {
  const auto& all = rowOf(leg.kind).coordinates;
  return std::find(all.begin(), all.end(), coordinate) != all.end();
}

/// φ, ψ, θ, d that any leg has; NaN for legs without them.
void addJoints(const std::string& suffix, const Manipulator& machine, const std::vector<JointMotion>& joints,
               JointVariables<double> JointMotion::*which, py::dict& out) {
  const std::vector<Leg>& legs = machine.parameters().legs;
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    if (std::none_of(legs.begin(), legs.end(), [&](const Leg& leg) { return has(leg, coordinate); })) continue;
    out[py::str(nameOf(coordinate) + suffix)] =
        table(joints, static_cast<py::ssize_t>(legs.size()), [&](const JointMotion& row, double* to) {
          const Vector6d& values = (row.*which).of(coordinate);
          for (std::size_t i = 0; i < legs.size(); ++i)
            to[i] = has(legs[i], coordinate) ? values(static_cast<Eigen::Index>(i)) : std::nan("");
        });
  }
}

py::dict inverseKinematics(const ScenarioWithSolver& self, const Motions& motion) {
  const Solver<double>& solver = self.kinematics.solver();
  Workspace<double> work;
  std::vector<JointMotion> joints(motion.rows.size());
  {
    const Unlocked unlocked;
    forRows(motion.rows.size(), [&](std::size_t k) {
      solver.inverseKinematics(motion.rows[k], work);
      joints[k] = {solver.angles(work), solver.rates(work), solver.accelerations(work)};
      requireFinite(joints[k].q.phi.data(), sizeof(JointMotion) / sizeof(double), "joint variable", motion.rows[k].t);
    });
  }
  py::dict out;
  addJoints("", *self.scenario.manipulator, joints, &JointMotion::q, out);
  addJoints("dot", *self.scenario.manipulator, joints, &JointMotion::q_dot, out);
  addJoints("ddot", *self.scenario.manipulator, joints, &JointMotion::q_ddot, out);
  return out;
}

[[noreturn]] void refuseIncomplete(int found, int of) {
  throw std::runtime_error("a pose may be missing: " + std::to_string(found) + " of " + std::to_string(of) +
                           " complex solutions were found");
}

std::vector<PlatformPose> posesOfPaper(const DirectKinematics& kinematics, const Vector6d& phi) {
  const PlatformPoses poses = kinematics.poses(phi);
  if (poses.counted != 8) refuseIncomplete(poses.counted, 8);
  return {poses.begin(), poses.end()};
}

std::vector<PlatformPose> posesOnSpheres(const Manipulator& machine, const Vector6d& driven) {
  const UpsPoses poses = upsPoses(machine, driven);
  if (!poses.complete()) refuseIncomplete(poses.counted + poses.at_infinity, 40);
  std::vector<PlatformPose> out;
  for (const UpsPose& pose : poses.list) {
    PlatformPose& row = out.emplace_back();
    row.p = pose.p;
    row.Q = pose.Q;
    row.q = pose.q;
    row.multiplicity = pose.multiplicity;
    row.residual = pose.residual;
    row.assembles = beyondStroke(machine, driven) < 0;
    row.front = true;
    for (int i = 0; i < leg_count; ++i) row.front = row.front && isOnItsBranch(machine.leg(i), driven(i), pose);
  }
  return out;
}

std::vector<PlatformPose> directKinematics(const ScenarioWithSolver& self, const py::object& coordinates) {
  const py::array_t<double> given = rowsOf(coordinates, leg_count, "coordinates");
  if (given.shape(0) != 1) throw py::value_error("coordinates: expected six numbers, of one pose");
  const bool on_spheres = tipsAreOnSpheres(*self.scenario.manipulator);
  if (!on_spheres && !self.scenario.manipulator->isOfThePaper())
    throw py::value_error(
        "direct_kinematics: all poses are known for six URS legs driven by phi, and for six UPS, RUS or PUS legs, also "
        "mixed, each driven by d, phi or d");
  const Vector6d driven = Eigen::Map<const Vector6d>(given.data());
  const Unlocked unlocked;
  const Manipulator& machine = *self.scenario.manipulator;
  return on_spheres ? posesOnSpheres(machine, driven) : posesOfPaper(self.kinematics, driven);
}

void addPose(py::module_& module) {
  using Pose = PlatformPose;
  py::class_<Pose>(module, "Pose", "One pose of the platform for given actuated coordinates.")
      .def_property_readonly(
          "p", [](const Pose& pose) { return vectorOf(pose.p.data(), 3); }, "Position of P in B, m: (3,).")
      .def_property_readonly(
          "q", [](const Pose& pose) { return vectorOf(pose.q.data(), 4); },
          "Orientation of M in B as a unit quaternion [w, x, y, z], w >= 0: (4,).")
      .def_property_readonly(
          "Q",
          [](const Pose& pose) {
            return py::array_t<double>({3, 3}, {8, 24}, pose.Q.data());
          },
          "The same as a matrix: (3, 3).")
      .def_readonly("multiplicity", &Pose::multiplicity, "Number of poses that rounding merges into this one.")
      .def_readonly("residual", &Pose::residual, "Largest mismatch of the legs, m.")
      .def_readonly("assembles", &Pose::assembles, "True if every leg is in reach.")
      .def_readonly("front", &Pose::front, "True if inverse kinematics returns the given coordinates.")
      .def("__repr__", [](const Pose& pose) {
        return "<ursula.Pose p=" + std::string(py::str(vectorOf(pose.p.data(), 3))) +
               " q=" + std::string(py::str(vectorOf(pose.q.data(), 4))) + (pose.assembles ? ">" : ", out of reach>");
      });
}

}  // namespace

std::shared_ptr<ScenarioWithSolver> warnedOf(std::shared_ptr<ScenarioWithSolver> read) {
  warnOf(warnings(read->scenario));
  return read;
}

void warnOf(const std::vector<std::string>& lines) {
  const Locked locked;
  for (const std::string& line : lines)
    if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 2) != 0) throw py::error_already_set();
}

void addScenario(py::module_& module) {
  addPose(module);
  addMechanism(module);
  py::class_<ScenarioWithSolver, std::shared_ptr<ScenarioWithSolver>> scenario(module, "Scenario", words::scenario);
  addCopies(scenario);
  const auto content = [](const ScenarioWithSolver& self) { return scenarioJson(self.scenario); };
  scenario
      .def(pickledText<ScenarioWithSolver>(
          [](const std::string& text, const std::string& file) { return parseScenario(text, file); }))
      .def(
          "__eq__",
          [content](const ScenarioWithSolver& self, const ScenarioWithSolver& other) {
            return content(self) == content(other);
          },
          py::is_operator())
      .def("__hash__", [content](const ScenarioWithSolver& self) { return std::hash<std::string>()(content(self)); })
      .def_property_readonly(
          "name", [](const ScenarioWithSolver& self) { return self.scenario.name; }, "The name that the file gives.")
      .def_property_readonly(
          "file", [](const ScenarioWithSolver& self) { return self.scenario.file; }, "The file that was read.")
      .def_property_readonly(
          "duration", [](const ScenarioWithSolver& self) { return self.scenario.trajectory->duration(); },
          "Duration of the motion, t_f, s.")
      .def_property_readonly(
          "legs", [](const ScenarioWithSolver& self) { return legsOf(self.scenario.manipulator->given()); },
          "The legs' numbers, with those that they share: kind, base_point, base_axis, platform_point, proximal, "
          "distal, ….")
      .def_property_readonly(
          "platform", [](const ScenarioWithSolver& self) { return platformOf(self.scenario.manipulator->given()); },
          "The platform's mass, kg, center_of_mass in M, m, and inertia about it, kg m².")
      .def_property_readonly(
          "gravity",
          [](const ScenarioWithSolver& self) { return vectorOf(self.scenario.manipulator->gravity().data(), 3); },
          "g in B, m/s²: (3,).")
      .def("motion", &motionAt, py::arg("t"), words::at)
      .def("inverse_dynamics", &inverseDynamics, py::arg("m"), py::kw_only(), py::arg("jobs") = 0,
           words::inverse_dynamics)
      .def("forward_dynamics", &forwardDynamics, py::arg("m"), py::arg("tau"), py::kw_only(), py::arg("jobs") = 0,
           words::forward_dynamics)
      .def("inverse_kinematics", &inverseKinematics, py::arg("m"), words::inverse_kinematics)
      .def("direct_kinematics", &directKinematics, py::arg("coordinates"), words::direct_kinematics)
      .def(
          "_repr_svg_", [](const ScenarioWithSolver& self) { return picture(self.scenario); },
          "The machine at the start of the motion, for notebooks.")
      .def("__repr__", [](const ScenarioWithSolver& self) { return "<ursula.Scenario '" + self.scenario.name + "'>"; });
  addDerivatives(scenario);
  addDocuments(module, scenario);
}

}  // namespace ursula::python
