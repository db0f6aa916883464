#pragma once

#include <vector>

#include "model/scenario.h"
#include "parts/fast/solver.h"

namespace ursula::bench {

/// Evenly spaced instants within the motion of a shipped scenario, with the input of every engine.
struct Poses {
  static constexpr int count = 64;

  /// "paper-helix".
  explicit Poses(const std::string& name);

  Scenario scenario;
  Solver<double> solver;
  std::vector<Motion<double>> motions;
  std::vector<JointMotion> joints;
  std::vector<Vector6d> efforts;  ///< by Solver

  const Manipulator& manipulator() const { return *scenario.manipulator; }
};

/// The paper's helix; made once.
const Poses& helix();

/// Displacements, rates and accelerations of the joints by the closed forms.
JointMotion jointMotion(const Solver<double>& solver, const Motion<double>& motion, Workspace<double>& work);

}  // namespace ursula::bench
