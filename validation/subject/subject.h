#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"
#include "nocsolver/spoilt_chain.h"

namespace ursula {

/// What a solver says of one motion beside its torques.
struct KinematicAnswer {
  JointMotion joints;
  BodyMotions<double> bodies;
  Matrix6d T = Matrix6d::Zero();       ///< of (24): t_P = T φ̇
  Matrix6d T_rate = Matrix6d::Zero();  ///< of (25)
};

/// What is on trial: a source of torques, and of kinematics where it has one. Called with the commanded motion.
struct Subject {
  std::string name;
  std::function<Vector6d(const Motion<double>&)> torques;            ///< N·m, conjugate to φ̇
  std::function<KinematicAnswer(const Motion<double>&)> kinematics;  ///< empty where only torques are judged
  /// [ω̇; p̈] of the platform under torques, state as commanded; empty where the subject solves no direct dynamics.
  std::function<Vector6d(const Motion<double>&, const Vector6d& torques)> accelerations;
  /// Told beforehand which motions torques will be asked for, for a subject that answers many at once sooner than one
  /// by one; empty where that is of no use. Changes no answer.
  std::function<void(const std::vector<Motion<double>>&)> foresee;
  /// The same solver for another machine, for invariances; empty where the subject is not a solver.
  std::function<Subject(const Manipulator&)> rebuilt;
};

/// Makes a subject for a scenario.
using SubjectOf = std::function<Subject(const Scenario&)>;

/// The NOC of this program.
Subject nocSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

/// The same with formulas that are wrong: a control that must fail.
Subject slippedSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load, const WithSlips& slips);

/// The general road with legs that are wrong, for machines of any kind: a control that must fail.
Subject spoiltSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load,
                      const SpoiltChain& reading);

/// Tells the subject, where it wants to know, that it will be asked at these instants of the trajectory, s.
void foresee(const Subject& subject, const Trajectory& trajectory, const std::vector<double>& instants);

/// [moment about P; force], in B, of a load on the platform at `motion`; zero where `load` is null.
Vector6d loadAtP(const Load* load, const Motion<double>& motion);

}  // namespace ursula
