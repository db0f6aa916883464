#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "parts/fast/solver.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "validation/evidence/injected_fault.h"
#include "validation/subject/parameters.h"
#include "validation/subject/subject.h"

namespace ursula {

/// One defect in an otherwise right validation, at one of three places. Empty members change nothing.
struct Defect {
  std::string name;
  std::string group;            ///< "formula", "term", "parameter", …
  SubjectOf subject = nullptr;  ///< the solver under test
  InjectedFault::ScenarioChange scenario =
      nullptr;               ///< the changed scenario for all formulations: commanded motion, load
  InjectedFault fault = {};  ///< a changed experiment
  /// Number of formulations that must catch it. It is 1 if by its nature only one can see it. Such defects are in
  /// direct dynamics and reactions (only Simbody has them), in shared parts, or in an engine, or do not affect the
  /// motion.
  int formulations_wanted = 2;
  bool control = false;  ///< no defect, but the same mechanism: it must pass
};

/// Returns every defect that `ursula prove` injects into this machine, one at a time, at least 150. Parts that a
/// machine lacks (a knee, a sliding coordinate) have no defect; some defects of zero values change nothing.
std::vector<Defect> allDefects(const Manipulator& machine);

/// Returns the solver with one wrong parameter.
Subject disturbedSubject(const Scenario& scenario, const Parameter& parameter, double relative);

}  // namespace ursula

// Helpers for the groups of defects. Internal.

namespace ursula {

using ChangeMachine = std::function<void(ManipulatorParameters&)>;
using ChangeMotion = std::function<void(Motion<double>&)>;
/// `right` are the right solver's torques at `motion`.
using ChangeTorques = std::function<Vector6d(const Vector6d& right, const Motion<double>& motion)>;

Manipulator changedMachine(const Manipulator& machine, const ChangeMachine& change);

/// Returns the NOC with a fault in its formulas, in its input or in a leg.
Defect wrongFormula(const std::string& name, const char* group, const WithFormulaErrors& fault);

/// Returns the same mechanism as a control, without a defect. It must pass; otherwise the mechanism itself triggers the
/// checks.
Defect control(Defect without_defect);

/// Gives the solver another machine.
Defect wrongMachine(const std::string& name, const std::string& group, const ChangeMachine& change);

/// Gives the solver another motion than the commanded one.
Defect wrongMotion(const std::string& name, const ChangeMotion& change);

/// Changes only the solver's torques; `change` creates the change for the scenario.
Defect wrongTorques(const std::string& name, const std::string& group,
                    const std::function<ChangeTorques(const Scenario&)>& change);

/// Returns the torques for a force against each joint, by power balance with the joints' rates for a unit rate of each
/// motor.
Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const JointVariables<double>& forces);

/// Returns the torques for a wrench on the platform, [moment about P; force].
Vector6d onActuators(const Solver<double>& solver, const Motion<double>& motion, const Vector6d& wrench);

/// The two ends of a pulse: at `share` of the motion and a 3000th of it later.
struct Pulse {
  double from = 0, to = 0;  ///< s
  Pulse(const Trajectory& trajectory, double share);
  bool has(double t) const { return t >= from && t <= to; }
};

void append(std::vector<Defect>& to, std::vector<Defect> more);

/// Returns the 0-based index of leg `number`, which is 1-based. With fewer legs it counts on from the first.
inline std::size_t legOf(const Manipulator& machine, int number) {
  return static_cast<std::size_t>((number - 1) % machine.legCount());
}
/// Returns another leg than legOf(machine, number).
std::size_t otherLeg(const Manipulator& machine, int number, std::size_t than);

/// Returns the coordinates of a leg, from its base.
inline const std::array<Coordinate, 3>& coordinatesOf(const Manipulator& machine, std::size_t leg) {
  return rowOf(machine.parameters().legs[leg].kind).coordinates;
}
/// Returns the kinds of the machine's legs, each once.
std::vector<LegKind> kindsOf(const Manipulator& machine);

// The groups of defects. Each is for any machine unless its comment says otherwise.
std::vector<Defect> formulaDefects(const Manipulator& machine);  ///< in noc/ and the paper's leg
std::vector<Defect> legDefects(const Manipulator& machine);      ///< in legs of other kinds
std::vector<Defect> fastDefects(const Manipulator& machine);
std::vector<Defect> parameterDefects(const Manipulator& machine);
std::vector<Defect> indexDefects(const Manipulator& machine);
std::vector<Defect> frameDefects(const Manipulator& machine);
std::vector<Defect> frictionDefects(const Manipulator& machine);
std::vector<Defect> motionDefects(const Manipulator& machine);
std::vector<Defect> torqueDefects(const Manipulator& machine);
std::vector<Defect> branchDefects(const Manipulator& machine);
std::vector<Defect> kinematicDefects(const Manipulator& machine);
std::vector<Defect> directDefects(const Manipulator& machine);
std::vector<Defect> hiddenDefects(const Manipulator& machine);
std::vector<Defect> sharedMotionDefects(const Manipulator& machine);
std::vector<Defect> sharedLoadDefects(const Manipulator& machine);
std::vector<Defect> experimentDefects(const Manipulator& machine);

}  // namespace ursula
