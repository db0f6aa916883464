#include "python/scenario.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/validate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/derivatives.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

/// Calls `each(row index)` for every row without Python's lock.
template <class F>
void forRows(const Motions& motion, F&& each) {
  const py::gil_scoped_release unlocked;
  for (std::size_t k = 0; k < motion.rows.size(); ++k) each(k);
}

py::array_t<double> empty(std::size_t rows, py::ssize_t width) {
  return py::array_t<double>({static_cast<py::ssize_t>(rows), width});
}

Motions motionAt(const ScenarioWithSolver& self, const py::object& t) {
  const py::array_t<double> instants = columnOf(t, "t");
  const double* data = instants.data();
  const auto count = static_cast<std::size_t>(instants.shape(0));
  for (std::size_t k = 0; k < count; ++k)
    if (!std::isfinite(data[k])) throw py::value_error("t[" + std::to_string(k) + "] is not finite");
  Motions out;
  const py::gil_scoped_release unlocked;
  out.rows.reserve(count);
  for (std::size_t k = 0; k < count; ++k) out.rows.push_back(self.scenario.trajectory->at(data[k]));
  return out;
}

py::array_t<double> inverseDynamics(const ScenarioWithSolver& self, const Motions& motion) {
  py::array_t<double> out = empty(motion.rows.size(), motor_count);
  double* to = out.mutable_data();
  Workspace<double> work;
  const Load* load = self.scenario.load.get();
  forRows(motion, [&](std::size_t k) {
    const Motion<double>& row = motion.rows[k];
    Eigen::Map<Vector6d>(to + motor_count * k) =
        self.kinematics.solver().inverseDynamics(row, work, loadAtP(load, row));
  });
  return out;
}

py::tuple forwardDynamics(const ScenarioWithSolver& self, const Motions& motion, const py::object& tau) {
  const py::array_t<double> given = rowsOf(tau, motor_count, "tau");
  if (static_cast<std::size_t>(given.shape(0)) != motion.rows.size())
    throw py::value_error("tau: " + std::to_string(given.shape(0)) + " rows, expected one for each of the motion's " +
                          std::to_string(motion.rows.size()));
  const double* torques = given.data();
  py::array_t<double> a = empty(motion.rows.size(), 3), alpha = empty(motion.rows.size(), 3);
  double *to_a = a.mutable_data(), *to_alpha = alpha.mutable_data();
  Workspace<double> work;
  const Load* load = self.scenario.load.get();
  forRows(motion, [&](std::size_t k) {
    const Motion<double>& row = motion.rows[k];
    const Vector6d of_row = Eigen::Map<const Vector6d>(torques + motor_count * k);
    const Vector6d found = self.kinematics.solver().directDynamics(row, of_row, work, loadAtP(load, row));
    Eigen::Map<Vector3d>(to_alpha + 3 * k) = found.head<3>();
    Eigen::Map<Vector3d>(to_a + 3 * k) = found.tail<3>();
  });
  return py::make_tuple(a, alpha);
}

bool has(const Leg& leg, Coordinate coordinate) {
  const auto& all = rowOf(leg.kind).coordinates;
  return std::find(all.begin(), all.end(), coordinate) != all.end();
}

/// φ, ψ, θ, d as far as any leg has them; NaN for those that have not.
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
  forRows(motion, [&](std::size_t k) {
    solver.inverseKinematics(motion.rows[k], work);
    joints[k] = {solver.angles(work), solver.rates(work), solver.accelerations(work)};
  });
  py::dict out;
  addJoints("", *self.scenario.manipulator, joints, &JointMotion::q, out);
  addJoints("dot", *self.scenario.manipulator, joints, &JointMotion::q_dot, out);
  addJoints("ddot", *self.scenario.manipulator, joints, &JointMotion::q_ddot, out);
  return out;
}

std::vector<PlatformPose> directKinematics(const ScenarioWithSolver& self, const py::object& phi) {
  const py::array_t<double> given = rowsOf(phi, leg_count, "phi");
  if (given.shape(0) != 1) throw py::value_error("phi: expected six angles");
  const Vector6d angles = Eigen::Map<const Vector6d>(given.data());
  const py::gil_scoped_release unlocked;
  const PlatformPoses poses = self.kinematics.poses(angles);
  if (poses.counted != 8)
    throw std::runtime_error("a pose may be missing: " + std::to_string(poses.counted) +
                             " of 8 solutions in the complex numbers were found");
  return {poses.begin(), poses.end()};
}

py::array_t<double> vectorOf(const double* from, py::ssize_t count) { return py::array_t<double>(count, from); }

void addPose(py::module_& module) {
  using Pose = PlatformPose;
  py::class_<Pose>(module, "Pose", "One pose of the platform for given actuated angles.")
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
      .def_readonly("multiplicity", &Pose::multiplicity, "How many poses cannot be told from this one.")
      .def_readonly("residual", &Pose::residual, "Largest mismatch of the legs, m.")
      .def_readonly("assembles", &Pose::assembles, "Every leg is in reach.")
      .def_readonly("front", &Pose::front, "Inverse kinematics answers with the angles given.");
}

}  // namespace

void addScenario(py::module_& module) {
  addPose(module);
  py::class_<ScenarioWithSolver, std::shared_ptr<ScenarioWithSolver>> scenario(module, "Scenario", words::scenario);
  scenario
      .def_property_readonly(
          "name", [](const ScenarioWithSolver& self) { return self.scenario.name; }, "As the file gives it.")
      .def_property_readonly(
          "file", [](const ScenarioWithSolver& self) { return self.scenario.file; }, "What was read.")
      .def_property_readonly(
          "duration", [](const ScenarioWithSolver& self) { return self.scenario.trajectory->duration(); },
          "Of the motion, t_f, s.")
      .def("motion", &motionAt, py::arg("t"), words::at)
      .def("inverse_dynamics", &inverseDynamics, py::arg("m"), words::inverse_dynamics)
      .def("forward_dynamics", &forwardDynamics, py::arg("m"), py::arg("tau"), words::forward_dynamics)
      .def("inverse_kinematics", &inverseKinematics, py::arg("m"), words::inverse_kinematics)
      .def("direct_kinematics", &directKinematics, py::arg("phi"), words::direct_kinematics)
      .def("__repr__", [](const ScenarioWithSolver& self) { return "<ursula.Scenario '" + self.scenario.name + "'>"; });
  addDerivatives(scenario);
  module.def(
      "read_scenario",
      [](const std::filesystem::path& file) {
        const py::gil_scoped_release unlocked;
        return std::make_shared<ScenarioWithSolver>(file);
      },
      py::arg("path"), words::read_scenario);
}

}  // namespace ursula::python
