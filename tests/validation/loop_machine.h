#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "parts/exchange/mechanism_reader.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula {

/// A machine of tests/vectors/loops/ and efforts for its motion.
class Machine {
 public:
  explicit Machine(const std::string& name, const std::function<void(MechanismParameters&)>& change = {})
      : scenario_(readMechanism(std::string(URSULA_LOOPS "/") + name + ".toml", &exchange::readMechanismModel)) {
    if (change) {
      MechanismParameters changed = parameters();
      change(changed);
      scenario_.mechanism = std::make_shared<const Mechanism>(changed);
    }
    constexpr int count = 61;
    for (int i = 0; i < count; ++i) t_.push_back(scenario_.trajectory->duration() * i / (count - 1));
  }

  const Mechanism& mechanism() const { return *scenario_.mechanism; }
  const MechanismScenario& scenario() const { return scenario_; }
  const std::vector<double>& instants() const { return t_; }
  MechanismParameters parameters() const { return mechanism().parameters(); }

  /// Right efforts of a machine with other numbers, `late` by a time.
  std::vector<MotorEfforts> efforts(const MechanismParameters& of, double late = 0) const {
    const Mechanism changed(of);
    const LoopSolver solver(changed);
    const LoopMotion motion(solver, *scenario_.trajectory);
    LoopWork work;
    std::vector<MotorEfforts> out;
    for (const double t : t_) out.push_back(motion.inverseDynamics(std::fmod(t - late + 2, 2), work));
    return out;
  }
  std::vector<MotorEfforts> efforts() const { return efforts(parameters()); }

  ValidationResult judge(const std::vector<MotorEfforts>& efforts) const {
    auto given = std::make_shared<GivenEfforts>();
    given->name = "efforts";
    given->t = t_;
    given->efforts = efforts;
    given->precision.assign(efforts.size(), MotorEfforts::Zero(efforts.front().size()));
    MechanismSubject subject;
    subject.about = {"efforts", Formulation::external};
    subject.given = given;
    return validateMechanism(scenario_, subject);
  }

 private:
  MechanismScenario scenario_;
  std::vector<double> t_;
};

template <class Change>
ValidationResult judgeChanged(const Machine& machine, const Change& change) {
  MechanismParameters parameters = machine.parameters();
  change(parameters);
  return machine.judge(machine.efforts(parameters));
}

template <class Change>
ValidationResult judgeEfforts(const Machine& machine, const Change& change) {
  std::vector<MotorEfforts> efforts = machine.efforts();
  for (std::size_t i = 0; i < efforts.size(); ++i) change(i, efforts[i]);
  return machine.judge(efforts);
}

/// Expects that a cause is named, of this kind, and of this term if one is given.
inline NamedCause named(const ValidationResult& result, CauseKind kind, const std::string& term = "any") {
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_TRUE(result.cause) << result.cause_words.cause;
  const NamedCause found = result.cause.value_or(NamedCause{});
  EXPECT_EQ(found.kind, kind) << result.cause_words.cause;
  EXPECT_TRUE(term == "any" || found.term == term) << found.term << ": " << result.cause_words.cause;
  return found;
}

/// The file's tree as a machine of its own, with its closures cut and every hinge driven.
class OpenMachine {
 public:
  explicit OpenMachine(const Machine& machine)
      : closed_(machine.mechanism()), motion_(closed_, *machine.scenario().trajectory) {
    MechanismParameters parameters = machine.parameters();
    auto& joints = parameters.joints;
    joints.erase(std::remove_if(joints.begin(), joints.end(), [](const auto& each) { return each.closure; }),
                 joints.end());
    for (const MechanismJoint& joint : joints) {
      const bool is_hinge = joint.kind == JointKind::revolute;
      possible_ = possible_ && (is_hinge || joint.kind == JointKind::fixed);
      const auto known = std::find(parameters.motors.begin(), parameters.motors.end(), joint.name);
      if (is_hinge && known == parameters.motors.end()) parameters.motors.push_back(joint.name);
    }
    if (possible_) tree_ = std::make_unique<LoopSolver>(Mechanism(parameters));
  }

  bool isPossible() const { return possible_; }

  /// Efforts of all hinges at the closed machine's motion, its velocity terms left out of the passive joints'
  /// accelerations if asked; those of the motors come first.
  Eigen::VectorXd forces(double t, bool with_bias, Eigen::MatrixXd& N) const {
    const MotorMotion right = motion_.trajectory().at(t);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(right.q.size());
    N.resize(static_cast<Eigen::Index>(tree_->mechanism().motorCount()), right.q.size());
    for (Eigen::Index k = 0; k < right.q.size(); ++k)
      N.col(k) = hinges({t, right.q, Eigen::VectorXd::Unit(right.q.size(), k), none}).qdot;
    MotorMotion all = hinges(right);
    if (!with_bias) all.qddot = N * right.qddot;
    loops::LoopPose pose = tree_->assembled();
    tree_->moveTo(all.q, pose);
    LoopWork work;
    return tree_->inverseDynamics(all, pose, work);
  }

 private:
  MotorMotion hinges(const MotorMotion& motors) const {
    LoopWork work;
    loops::LoopPose pose = motion_.near(motors.t);
    closed_.moveTo(motors.q, pose);
    closed_.kinematics(motors, pose, work);
    const auto count = static_cast<Eigen::Index>(tree_->mechanism().motorCount());
    MotorMotion out{motors.t, Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
    const Eigen::Index own = motors.q.size();
    out.q.head(own) = motors.q, out.qdot.head(own) = motors.qdot, out.qddot.head(own) = motors.qddot;
    for (Eigen::Index k = own; k < count; ++k)
      for (const LoopSolver::JointValue& each : closed_.joints(work))
        if (each.name == tree_->mechanism().motor(static_cast<std::size_t>(k)).name + "_rad")
          out.q(k) = each.value, out.qdot(k) = each.rate, out.qddot(k) = each.acceleration;
    return out;
  }

  LoopSolver closed_;
  LoopMotion motion_;
  std::unique_ptr<LoopSolver> tree_;
  bool possible_ = true;
};

}  // namespace ursula
