#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/joint_variables.h"
#include "model/judged_subject.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"
#include "nocsolver/legs/leg_model.h"

namespace ursula {

/// A solver's results for one motion beside its torques.
struct KinematicAnswer {
  JointMotion joints;
  BodyMotions<double> bodies;
  Matrix6d T = Matrix6d::Zero();       ///< of (24): t_P = T φ̇
  Matrix6d T_rate = Matrix6d::Zero();  ///< of (25)
};

/// D of (33), 12 rows per leg, and T of (32a), 78 × 6.
struct Complement {
  Eigen::MatrixXd D, T;
};

/// Torques that a subject gave for the commanded motion at t.
struct Answered {
  double t = 0;
  Vector6d torques = Vector6d::Zero();
};

/// The solver under test: a source of torques, and possibly of kinematics. It is called with the commanded motion.
struct Subject : JudgedSubject {
  std::function<Vector6d(const Motion<double>&)> torques;            ///< N·m or N, conjugate to the motors' rates
  std::function<KinematicAnswer(const Motion<double>&)> kinematics;  ///< empty if only torques are judged
  /// [ω̇; p̈] of the platform under torques in the commanded state; empty if the subject lacks direct dynamics.
  std::function<Vector6d(const Motion<double>&, const Vector6d& torques)> accelerations;
  std::function<Complement(const Motion<double>&)> complement;  ///< empty if the subject computes none
  std::function<Reactions(const Motion<double>&)> reactions;    ///< under its own torques; empty if it computes none
  /// Receives in advance the motions whose torques will be needed, for a subject that is faster with many at once.
  /// Empty if that is useless. Changes no answer.
  std::function<void(const std::vector<Motion<double>>&)> foresee;
  /// Returns all answers so far; empty if it stores nothing.
  std::function<std::vector<Answered>()> answers;
  /// At most about so many questions, of a subject that is slow: replays then run on its answers, interpolated
  /// (InterpolatedAnswers). 0: as many as the integrators have.
  int most_questions = 0;
  /// Creates the same solver for another machine, for invariances; empty if the subject is not a solver.
  std::function<Subject(const Manipulator&)> rebuilt;
};

/// Returns the same subject with stored answers. For one thread.
Subject recorded(Subject subject);

/// Creates a subject for a scenario.
using SubjectOf = std::function<Subject(const Scenario&)>;

/// This program's NOC, as in the paper; validations judge it.
Subject nocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

/// The same for numbers already read.
Subject nocSubject(const MachineParameters<double>& machine, const std::shared_ptr<const Load>& load);

/// Announces to the subject, if it wants to know, the instants of the trajectory that will be asked for, s.
void foresee(const Subject& subject, const Trajectory& trajectory, const std::vector<double>& instants);

/// [moment about P; force], in B, of a load on the platform at `motion`; zero if `load` is null.
Vector6d loadAtP(const Load* load, const Motion<double>& motion);

}  // namespace ursula
