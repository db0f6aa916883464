#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <ursula/mechanism.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "python/made.h"

namespace ursula::python {

/// A scenario with [mechanism]. Its solver is made when it is first needed, because a scenario whose loops cannot
/// follow can be read, too.
struct MechanismWithSolver {
  explicit MechanismWithSolver(MechanismScenario given) : scenario(std::move(given)) {}
  /// Throws like MechanismAlong. Is called without Python's lock.
  const MechanismAlong& along() const;
  pybind11::ssize_t motors() const { return static_cast<pybind11::ssize_t>(scenario.mechanism->motorCount()); }

  MechanismScenario scenario;

 private:
  mutable std::mutex guard_;
  mutable std::unique_ptr<MechanismAlong> along_;
};

/// The motion of the motors and of all other joints at N instants; rows are instants. Python sees views of it.
struct MechanismMotion {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd t;
  Rows q, qdot, qddot;
  std::vector<std::string> names;  ///< of the other joints' coordinates
  Rows joints, joint_rates, joint_accelerations;

  /// Creates `count` rows to be filled.
  static MechanismMotion of(Eigen::Index count, Eigen::Index motors, std::vector<std::string> names);
  void set(Eigen::Index row, const MotorMotion& motors, const std::vector<LoopSolver::JointValue>& others);
  MotorMotion at(Eigen::Index row) const { return {t(row), q.row(row), qdot.row(row), qddot.row(row)}; }
};

/// Reads or parses a scenario with [mechanism], and warns (UserWarning) of what is odd in its model. Is called without
/// Python's lock. Throws ScenarioError.
std::shared_ptr<MechanismWithSolver> mechanismOf(const std::filesystem::path& file);
std::shared_ptr<MechanismWithSolver> mechanismOf(const std::string& text, const std::filesystem::path& file);

/// Returns the assemblies for the motors' motion at successive instants, each continued from the one before, the first
/// from that at the start of the scenario's motion. Is called without Python's lock. Throws LoopError.
MechanismMotion assemblies(const MechanismWithSolver& self, const std::vector<MotorMotion>& instants);

/// Tries the motion. Returns the warnings of the model. Is called without Python's lock.
std::vector<std::string> checked(const MechanismWithSolver& self);

void addMechanism(pybind11::module_& module);
void addMechanismMotion(pybind11::module_& module);

}  // namespace ursula::python
