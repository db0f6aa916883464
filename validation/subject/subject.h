#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"
#include "nocsolver/legs/reading.h"

namespace ursula {

/// What a solver says of one motion beside its torques.
struct KinematicAnswer {
  JointMotion joints;
  BodyMotions<double> bodies;
  Matrix6d T = Matrix6d::Zero();       ///< of (24): t_P = T φ̇
  Matrix6d T_rate = Matrix6d::Zero();  ///< of (25)
};

/// D of (33), 12 rows a leg, and T of (32a), 78 × 6.
struct Complement {
  Eigen::MatrixXd D, T;
};

/// Whose formulas a subject evaluates: the paper's as they are printed, the kernels that users call, or somebody
/// else's.
enum class Formulation { noc, fast, external };
/// "noc", "fast" or "external".
const char* name(Formulation formulation);

/// Torques that a subject gave for the commanded motion at t.
struct Answered {
  double t = 0;
  Vector6d torques = Vector6d::Zero();
};

/// What is on trial: a source of torques, and of kinematics where it has one. Called with the commanded motion.
struct Subject {
  std::string name;
  Formulation formulation = Formulation::external;
  std::function<Vector6d(const Motion<double>&)> torques;            ///< N·m, conjugate to φ̇
  std::function<KinematicAnswer(const Motion<double>&)> kinematics;  ///< empty where only torques are judged
  /// [ω̇; p̈] of the platform under torques, state as commanded; empty where the subject solves no direct dynamics.
  std::function<Vector6d(const Motion<double>&, const Vector6d& torques)> accelerations;
  std::function<Complement(const Motion<double>&)> complement;  ///< empty where the subject forms none
  std::function<Reactions(const Motion<double>&)> reactions;    ///< under its own torques; empty where it finds none
  /// Told beforehand which motions torques will be asked for, for a subject that answers many at once sooner than one
  /// by one; empty where that is of no use. Changes no answer.
  std::function<void(const std::vector<Motion<double>>&)> foresee;
  /// All that it has answered so far; empty where it keeps nothing.
  std::function<std::vector<Answered>()> answers;
  /// The same solver for another machine, for invariances; empty where the subject is not a solver.
  std::function<Subject(const Manipulator&)> rebuilt;
};

/// The same subject, which keeps its answers. For one thread.
Subject recorded(Subject subject);

/// Makes a subject for a scenario.
using SubjectOf = std::function<Subject(const Scenario&)>;

/// The NOC of this program, as the paper has it: what validations judge.
Subject nocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

/// The same of numbers already read.
Subject nocSubject(const MachineParameters<double>& machine, const std::shared_ptr<const Load>& load);

/// The same with an injected fault: a control that must fail.
Subject wrongNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                        const WithFormulaErrors& fault);

/// The kernels that users call: torques and accelerations alone. Another formulation beside the NOC, and a fast one.
Subject fastSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

/// The formulas of the NOC evaluated in long double: what rounding in doubles is measured by.
Subject longNocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

/// Tells the subject, where it wants to know, that it will be asked at these instants of the trajectory, s.
void foresee(const Subject& subject, const Trajectory& trajectory, const std::vector<double>& instants);

/// [moment about P; force], in B, of a load on the platform at `motion`; zero where `load` is null.
Vector6d loadAtP(const Load* load, const Motion<double>& motion);

}  // namespace ursula
