#include "python/mechanism.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <ursula/scenario.h>

#include <algorithm>
#include <string>
#include <vector>

#include "python/archive.h"
#include "python/bindings.h"
#include "python/motion.h"
#include "python/words.h"

namespace ursula::python {
namespace py = pybind11;
namespace {

std::vector<std::string> namesOf(const std::vector<LoopSolver::JointValue>& joints) {
  std::vector<std::string> out;
  for (const LoopSolver::JointValue& each : joints) out.push_back(each.name);
  return out;
}

MechanismMotion motionAt(const MechanismWithSolver& self, const py::object& t) {
  const py::array_t<double> instants = columnOf(t, "t");
  const double duration = self.scenario.trajectory->duration();
  refuseOutside(instants, duration);
  const double* data = instants.data();
  const std::size_t count = instants.shape(0);
  const Unlocked unlocked;
  const LoopMotion& path = self.along().motion();
  LoopWork work;
  path.solver().kinematics(path.trajectory().at(0), path.near(0), work);
  MechanismMotion out =
      MechanismMotion::of(static_cast<Eigen::Index>(count), self.motors(), namesOf(path.solver().joints(work)));
  forRows(count, [&](std::size_t k) {
    const double at = std::clamp(data[k], 0.0, duration);
    const MotorMotion motors = path.trajectory().at(at);
    path.solver().kinematics(motors, path.near(at), work);
    out.set(static_cast<Eigen::Index>(k), motors, path.solver().joints(work));
  });
  return out;
}

void requireMotors(const MechanismWithSolver& self, const MechanismMotion& motion) {
  if (motion.q.cols() != self.motors())
    throw py::value_error("m: a motion of " + std::to_string(motion.q.cols()) + " motors, expected " +
                          std::to_string(self.motors()) + ", those of the scenario");
}

/// Computes N × n numbers, one row for each instant.
template <class Row>
py::array_t<double> rowByRow(const MechanismWithSolver& self, const MechanismMotion& motion, const Row& row) {
  requireMotors(self, motion);
  py::array_t<double> out({motion.t.size(), self.motors()});
  double* to = out.mutable_data();
  const Unlocked unlocked;
  const LoopMotion& path = self.along().motion();
  LoopWork work;
  forRows(motion.t.size(), [&](std::size_t k) {
    const auto at = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd values = row(path, at, motion.at(at), work);
    std::copy(values.begin(), values.end(), to + at * self.motors());
  });
  return out;
}

py::array_t<double> inverseDynamics(const MechanismWithSolver& self, const MechanismMotion& motion) {
  return rowByRow(self, motion, [](const LoopMotion& path, Eigen::Index, const MotorMotion& motors, LoopWork& work) {
    return path.solver().inverseDynamics(motors, path.near(motors.t), work);
  });
}

py::array_t<double> directDynamics(const MechanismWithSolver& self, const MechanismMotion& motion,
                                   const py::object& tau) {
  const py::array_t<double> given = rowsOf(tau, self.motors(), "tau");
  if (given.shape(0) != motion.t.size())
    throw py::value_error("tau: " + std::to_string(given.shape(0)) + " rows, expected one for each of the motion's " +
                          std::to_string(motion.t.size()));
  return rowByRow(self, motion,
                  [from = given.data(), n = self.motors()](const LoopMotion& path, Eigen::Index k,
                                                           const MotorMotion& motors, LoopWork& work) {
                    const Eigen::VectorXd efforts = Eigen::Map<const Eigen::VectorXd>(from + k * n, n);
                    return path.solver().directDynamics(motors, efforts, path.near(motors.t), work);
                  });
}

template <class Read>
std::shared_ptr<MechanismWithSolver> warnedOf(const Read& read) {
  std::shared_ptr<MechanismWithSolver> out;
  try {
    out = std::make_shared<MechanismWithSolver>(read());
  } catch (const InputError& error) {
    throw ScenarioError(error.what());
  }
  warnOf(out->scenario.read.warnings);
  return out;
}

void addBody(py::module_& module) {
  py::class_<MechanismBody> body(module, "Body", words::body);
  addCopies(body);
  body.def_readonly("name", &MechanismBody::name, "As in the model file.")
      .def_readonly("mass", &MechanismBody::mass, "kg.")
      .def_readonly("fixed", &MechanismBody::fixed, "True for the world and for what stands still with it.")
      .def_property_readonly(
          "center_of_mass",
          [](const MechanismBody& self) { return py::array_t<double>(3, self.center_of_mass.data()); },
          "Position in the world at the file's pose, m: (3,).")
      .def_property_readonly(
          "inertia",
          [](const MechanismBody& self) {
            return py::array_t<double>({3, 3}, {8, 24}, self.inertia.data());
          },
          "About the mass centre, in the world's axes, kg m²: (3, 3).")
      .def("__repr__", [](const MechanismBody& self) {
        return "<ursula.Body '" + self.name + "' of " + shown(self.mass) + " kg>";
      });
}

MechanismMotion directKinematics(const MechanismWithSolver& self, const py::object& coordinates) {
  const py::array_t<double> given = rowsOf(coordinates, self.motors(), "coordinates");
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(self.motors());
  std::vector<MotorMotion> instants;
  for (py::ssize_t k = 0; k < given.shape(0); ++k) {
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(given.data() + k * self.motors(), self.motors());
    instants.push_back({0, q, rest, rest});
  }
  const Unlocked unlocked;
  return assemblies(self, instants);
}

std::vector<std::string> motorNames(const MechanismWithSolver& self) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < self.scenario.mechanism->motorCount(); ++k)
    out.push_back(self.scenario.mechanism->motor(k).name);
  return out;
}

}  // namespace

const MechanismAlong& MechanismWithSolver::along() const {
  const std::lock_guard<std::mutex> lock(guard_);
  if (!along_) along_ = std::make_unique<MechanismAlong>(scenario);
  return *along_;
}

std::shared_ptr<MechanismWithSolver> mechanismOf(const std::filesystem::path& file) {
  return warnedOf([&] { return readMechanism(file); });
}

std::shared_ptr<MechanismWithSolver> mechanismOf(const std::string& text, const std::filesystem::path& file) {
  return warnedOf([&] { return parseMechanism(text, file); });
}

MechanismMotion assemblies(const MechanismWithSolver& self, const std::vector<MotorMotion>& instants) {
  const LoopMotion& path = self.along().motion();
  loops::LoopPose pose = path.near(0);
  LoopWork work;
  path.solver().kinematics(path.trajectory().at(0), pose, work);
  MechanismMotion out = MechanismMotion::of(static_cast<Eigen::Index>(instants.size()), self.motors(),
                                            namesOf(path.solver().joints(work)));
  for (std::size_t k = 0; k < instants.size(); ++k) {
    path.solver().moveTo(instants[k].q, pose);
    path.solver().kinematics(instants[k], pose, work);
    pose = work.pose;
    out.set(static_cast<Eigen::Index>(k), instants[k], path.solver().joints(work));
  }
  return out;
}

std::vector<std::string> checked(const MechanismWithSolver& self) {
  const LoopMotion& path = self.along().motion();
  LoopWork work;
  for (const double t : equallySpaced(self.scenario.trajectory->duration(), self.scenario.simulation.samples))
    static_cast<void>(path.inverseDynamics(t, work));
  return self.scenario.read.warnings;
}

void addMechanism(py::module_& module) {
  using S = MechanismWithSolver;
  addBody(module);
  addMechanismMotion(module);
  py::class_<S, std::shared_ptr<S>> scenario(module, "MechanismScenario", words::mechanism_scenario);
  addCopies(scenario);
  scenario
      .def(pickledText<S>([](const std::string& text, const std::string& file) { return parseMechanism(text, file); }))
      .def_property_readonly(
          "name", [](const S& self) { return self.scenario.name; }, "The name that the file gives.")
      .def_property_readonly(
          "file", [](const S& self) { return self.scenario.file; }, "The file that was read.")
      .def_property_readonly(
          "model", [](const S& self) { return self.scenario.model; }, "The model file that it names.")
      .def_property_readonly(
          "duration", [](const S& self) { return self.scenario.trajectory->duration(); }, "Duration of the motion, s.")
      .def_property_readonly("motors", &motorNames, "The driven joints, in the order of efforts: a list of names.")
      .def_property_readonly(
          "bodies", [](const S& self) { return self.scenario.mechanism->bodies(); },
          "The bodies of the model: a list of Body.")
      .def_property_readonly(
          "assumptions", [](const S& self) { return self.scenario.read.assumptions; },
          "What was assumed on reading the model: a list of sentences.")
      .def("motion", &motionAt, py::arg("t"), words::mechanism_at)
      .def("inverse_dynamics", &inverseDynamics, py::arg("m"), words::mechanism_inverse_dynamics)
      .def("direct_dynamics", &directDynamics, py::arg("m"), py::arg("tau"), words::mechanism_direct_dynamics)
      .def("forward_dynamics", &directDynamics, py::arg("m"), py::arg("tau"), words::mechanism_direct_dynamics)
      .def("direct_kinematics", &directKinematics, py::arg("coordinates"), words::mechanism_direct_kinematics)
      .def(
          "to_dict", [](const S& self) { return fromJson(scenarioJson(self.scenario.text, self.scenario.file)); },
          words::to_dict)
      .def(
          "to_toml", [](const S& self) { return self.scenario.text; }, words::to_toml)
      .def("__repr__", [](const S& self) { return "<ursula.MechanismScenario '" + self.scenario.name + "'>"; });
}

}  // namespace ursula::python
