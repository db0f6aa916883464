#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nocsolver/solver.h"
#include "validation/prove/defects.h"

// What the groups of defects are made with. Internal.

namespace ursula {

using ChangeMachine = std::function<void(ManipulatorParameters&)>;
using ChangeMotion = std::function<void(Motion<double>&)>;
/// `right` is what the right solver says at `motion`.
using ChangeTorques = std::function<Vector6d(const Vector6d& right, const Motion<double>& motion)>;

Manipulator changedMachine(const Manipulator& machine, const ChangeMachine& change);

/// The solver of another machine.
Defect wrongMachine(const std::string& name, const std::string& group, const ChangeMachine& change);

/// The solver is told another motion than the one commanded.
Defect wrongMotion(const std::string& name, const ChangeMotion& change);

/// The torques alone are spoilt on their way out; `change` is made for the scenario.
Defect wrongTorques(const std::string& name, const std::string& group,
                    const std::function<ChangeTorques(const Scenario&)>& change);

/// Torques for a force against each joint, by the power that they take: the joints' rates for a unit rate of each
/// motor.
Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const JointVariables<double>& forces);

/// Torques for a wrench on the platform, [moment about P; force].
Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& wrench);

/// Two instants, a pulse's ends: `share` of the motion and a 3000th of it later.
struct Pulse {
  double from = 0, to = 0;  ///< s
  Pulse(const Trajectory& trajectory, double share);
  bool has(double t) const { return t >= from && t <= to; }
};

void append(std::vector<Defect>& to, std::vector<Defect> more);

// The groups.
std::vector<Defect> formulaDefects();
std::vector<Defect> parameterDefects();
std::vector<Defect> indexDefects();
std::vector<Defect> frameDefects();
std::vector<Defect> frictionDefects();
std::vector<Defect> motionDefects();
std::vector<Defect> torqueDefects();
std::vector<Defect> branchDefects();
std::vector<Defect> kinematicDefects();
std::vector<Defect> directDefects();
std::vector<Defect> hiddenDefects();
std::vector<Defect> sharedMotionDefects();
std::vector<Defect> sharedLoadDefects();
std::vector<Defect> readingDefects();
std::vector<Defect> experimentDefects();

}  // namespace ursula
