#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/validation/loop_machine.h"

namespace ursula {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void loseFriction(MechanismParameters& machine) {
  for (MechanismJoint& joint : machine.joints) joint.damping = joint.friction = 0;
}

std::size_t passiveHinge(const MechanismParameters& machine) {
  for (std::size_t j = 0; j < machine.joints.size(); ++j) {
    const MechanismJoint& joint = machine.joints[j];
    const bool is_motor = std::count(machine.motors.begin(), machine.motors.end(), joint.name) > 0;
    if (joint.kind == JointKind::revolute && !joint.closure && !is_motor) return j;
  }
  throw std::logic_error("no passive hinge");
}

/// M q̈ and weights alone, as with C = 0; a passive rotor's velocity products are left out, too.
TEST(LoopMistake, velocitiesLeftOutAreNamedWithAPassiveRotor) {
  const Machine machine("fourbar", [](MechanismParameters& of) {
    loseFriction(of);
    of.joints[passiveHinge(of)].rotor_inertia = 0.3;
  });
  const LoopSolver solver(machine.mechanism());
  const LoopMotion motion(solver, *machine.scenario().trajectory);
  std::vector<MotorEfforts> efforts;
  for (const double t : machine.instants()) {
    MotorMotion at = motion.trajectory().at(t);
    loops::LoopPose pose = motion.near(t);
    solver.moveTo(at.q, pose);
    at.qdot.setZero();
    LoopWork work;
    efforts.push_back(solver.inverseDynamics(at, pose, work));
  }
  const NamedCause result = named(machine.judge(efforts), CauseKind::missing_term, "coriolis");
  EXPECT_EQ(result.body, "all");
}

TEST(LoopMistake, springsMeasuredFromZeroAreNamed) {
  const Machine machine("fourbar", [](MechanismParameters& of) {
    for (MechanismJoint& joint : of.joints)
      if (joint.kind == JointKind::revolute && !joint.closure) joint.stiffness = 2, joint.spring_reference = 0.4;
  });
  MechanismParameters from_zero = machine.parameters();
  for (MechanismJoint& joint : from_zero.joints) joint.spring_reference = 0;
  const ValidationResult result = machine.judge(machine.efforts(from_zero));
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::missing_term);
  EXPECT_EQ(result.cause->term, "springs");
  EXPECT_NE(result.cause_words.cause.find("rest positions"), std::string::npos);
}

/// The rods of a delta, and not its arms.
TEST(LoopMistake, weightsOfBodiesOfOneMassAreNamedTogether) {
  const Machine machine("delta");
  MechanismParameters without = machine.parameters();
  double least = 1e300;
  for (const MechanismBody& body : without.bodies)
    if (!body.fixed && body.mass > 0) least = std::min(least, body.mass);
  std::size_t rods = 0;
  for (MechanismBody& body : without.bodies)
    if (body.mass == least) body.weightless = true, ++rods;
  ASSERT_GE(rods, 2u);
  const NamedCause result = named(machine.judge(machine.efforts(without)), CauseKind::missing_term, "gravity");
  EXPECT_EQ(static_cast<std::size_t>(std::count(result.body.begin(), result.body.end(), ',')) + 1, rods) << result.body;
}

TEST(LoopMistake, transmissionOfTheStartIsNamed) {
  const Machine machine("fourbar", loseFriction);
  const OpenMachine open(machine);
  ASSERT_TRUE(open.isPossible());
  MatrixXd N_0, N;
  open.forces(0, true, N_0);
  std::vector<MotorEfforts> efforts;
  for (const double t : machine.instants()) efforts.push_back(N_0.transpose() * open.forces(t, true, N));
  named(machine.judge(efforts), CauseKind::closure, "constant");
}

/// Coulomb friction by the rate's sign differs from the smoothed law near rest alone.
TEST(LoopMistake, frictionWithoutSmoothingIsNamed) {
  const Machine machine("rps3");
  const LoopSolver solver(machine.mechanism());
  const LoopMotion motion(solver, *machine.scenario().trajectory);
  std::vector<MotorEfforts> efforts = machine.efforts();
  for (std::size_t i = 0; i < efforts.size(); ++i) {
    const MotorMotion at = motion.trajectory().at(machine.instants()[i]);
    for (Eigen::Index k = 0; k < at.q.size(); ++k) {
      const MechanismJoint& joint = machine.mechanism().motor(static_cast<std::size_t>(k));
      const double rate = at.qdot(k), sign = rate > 0 ? 1 : rate < 0 ? -1 : 0;
      if (k == 0) efforts[i](k) += joint.friction * (sign - std::tanh(rate / joint.smoothing()));
    }
  }
  const NamedCause result = named(machine.judge(efforts), CauseKind::parameter);
  EXPECT_EQ(result.joint, machine.mechanism().motor(0).name);
  EXPECT_EQ(result.parameter, "joint." + result.joint + ".smoothing_speed");
}

/// 2 omega x v of each rod in its cylinder; the plate's own acceleration is right.
TEST(LoopMistake, coriolisOfSlidesIsNamed) {
  const Machine machine("rps3");
  const LoopSolver solver(machine.mechanism());
  const LoopMotion motion(solver, *machine.scenario().trajectory);
  std::vector<MotorEfforts> efforts = machine.efforts();
  LoopWork work;
  for (std::size_t i = 0; i < efforts.size(); ++i) {
    static_cast<void>(motion.inverseDynamics(machine.instants()[i], work));
    const MotorMotion at = motion.trajectory().at(machine.instants()[i]);
    for (std::size_t k = 0; k < machine.mechanism().motorCount(); ++k) {
      const MechanismJoint& joint = machine.mechanism().motor(k);
      const BodyState& cylinder = work.bodies[joint.parent];
      const Vector3d omega = cylinder.twist.head<3>(), axis = cylinder.displacement.linear() * joint.axis[0];
      const Vector3d left_out = 2 * at.qdot(static_cast<Eigen::Index>(k)) * omega.cross(axis);
      efforts[i] -=
          work.T[joint.child].bottomRows<3>().transpose() * (machine.mechanism().bodies()[joint.child].mass * left_out);
    }
  }
  const ValidationResult result = machine.judge(efforts);
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::missing_term);
  EXPECT_EQ(result.cause->term, "coriolis");
  EXPECT_NE(result.cause_words.cause.find("what slides"), std::string::npos) << result.cause_words.cause;
}

/// Efforts that are printed as multiples of `unit`.
ValidationResult judgePrinted(const Machine& machine, const std::vector<MotorEfforts>& efforts, double unit) {
  auto given = std::make_shared<GivenEfforts>();
  given->name = "efforts";
  given->t = machine.instants();
  given->efforts = efforts;
  for (MotorEfforts& each : given->efforts)
    for (double& one : each) one = unit * std::round(one / unit);
  given->precision.assign(efforts.size(), MotorEfforts::Constant(efforts.front().size(), unit / 2));
  MechanismSubject subject;
  subject.about = {"efforts", Formulation::external};
  subject.given = given;
  return validateMechanism(machine.scenario(), subject);
}

/// Digits as coarse as the efforts leave much open; a remainder that is smooth in spite of them is another error.
TEST(LoopMistake, constantEffortsOfFewDigitsHaveNoCause) {
  const Machine machine("ankle");
  std::vector<MotorEfforts> efforts = machine.efforts();
  for (MotorEfforts& each : efforts) each << 1, -1;
  const ValidationResult constant = judgePrinted(machine, efforts, 1);
  EXPECT_EQ(constant.verdict, Verdict::fail);
  EXPECT_FALSE(constant.cause) << constant.cause_words.cause;
  EXPECT_TRUE(constant.causes.empty()) << constant.cause_words.cause;
  MechanismParameters tilted = machine.parameters();
  tilted.gravity.y() -= 5;
  const ValidationResult known = judgePrinted(machine, machine.efforts(tilted), 0.001);
  ASSERT_TRUE(known.cause) << known.cause_words.cause;
  EXPECT_EQ(known.cause->parameter, "gravity.1");
  EXPECT_NEAR(known.cause->found.value_or(0), -5, 0.01);
}

/// A cause of several alone explains less than all, and what it explains is what the deviation lacks without the rest.
TEST(LoopMistake, sharesOfSeveralAreTheirOwn) {
  const Machine machine("fourbar");
  const std::size_t motor = machine.mechanism().motors().front();
  MechanismParameters damped = machine.parameters();
  damped.joints[motor].damping += 0.05;
  const std::vector<MotorEfforts> right = machine.efforts(), alone = machine.efforts(damped);
  std::vector<MotorEfforts> both = alone;
  for (MotorEfforts& each : both) each(0) += 1e-3;
  double left = 0, all = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    left += (both[i] - alone[i]).squaredNorm();
    all += (both[i] - right[i]).squaredNorm();
  }
  const ValidationResult result = machine.judge(both);
  ASSERT_EQ(result.causes_together.size(), 2U) << result.cause_words.cause;
  EXPECT_EQ(result.causes_together[0].parameter, "joint." + machine.mechanism().joints()[motor].name + ".damping");
  EXPECT_NEAR(result.causes_together[0].explained, 1 - left / all, 1e-3 * left / all);
  EXPECT_LT(result.causes_together[0].explained, 1);
  EXPECT_EQ(result.cause_words.cause.find("(100 %)"), std::string::npos) << result.cause_words.cause;
}

TEST(LoopMistake, everyUnitOfColumnsIsNamed) {
  const Machine machine("fourbar");
  for (const double unit : {9.80665, 0.0980665, 1.3558179483314004, 0.1129848290276167, 0.00706155181422604})
    for (const double factor : {unit, 1 / unit}) {
      named(judgeEfforts(machine, [&](std::size_t, auto& tau) { tau *= factor; }), CauseKind::units);
    }
  named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau *= 10.21; }), CauseKind::scale);
}

TEST(LoopMistake, significantDigitsOfASolverAreNamed) {
  const Machine machine("planar3rrr");
  const auto printed = [](double value) { return std::stod(fmt::format("{:.6g}", value)); };
  const ValidationResult result = judgeEfforts(machine, [&](std::size_t, auto& tau) { tau = tau.unaryExpr(printed); });
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::digits);
  EXPECT_NE(result.cause_words.cause.find("6 significant digits"), std::string::npos) << result.cause_words.cause;
  const ValidationResult wrong =
      judgeEfforts(machine, [&](std::size_t, auto& tau) { tau = (1.01 * tau).unaryExpr(printed).eval(); });
  EXPECT_TRUE(!wrong.cause || wrong.cause->kind != CauseKind::digits) << wrong.cause_words.cause;
}

TEST(LoopMistake, oneOffsetOfSeveralMotorsHasItsValue) {
  const Machine machine("ankle");
  const NamedCause equal =
      named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau.array() += 0.2; }), CauseKind::offset);
  EXPECT_NEAR(equal.found.value_or(0), 0.2, 1e-9);
  EXPECT_EQ(equal.expected.value_or(1), 0);
  EXPECT_EQ(equal.unit, "N m");
  const NamedCause apart =
      named(judgeEfforts(machine, [](std::size_t, auto& tau) { tau(0) += 0.2, tau(1) += 0.3; }), CauseKind::offset);
  EXPECT_FALSE(apart.found);
}

/// What is left out of one joint is told by the number that it has.
TEST(LoopMistake, termsOfJointsTellTheirNumbers) {
  const Machine machine("fourbar");
  const std::size_t motor = machine.mechanism().motors().front();
  const std::string joint = "joint." + machine.mechanism().joints()[motor].name;
  Machine loaded("fourbar", [&](MechanismParameters& p) {
    MechanismJoint& its = p.joints[motor];
    its.damping = 0.2, its.friction = 0.3, its.stiffness = 2, its.spring_reference = 0.4;
  });
  const std::pair<const char*, double MechanismJoint::*> numbers[] = {{"damping", &MechanismJoint::damping},
                                                                      {"friction", &MechanismJoint::friction},
                                                                      {"stiffness", &MechanismJoint::stiffness},
                                                                      {"springref", &MechanismJoint::spring_reference}};
  for (const auto& each : numbers) {
    const char* name = each.first;
    const auto member = each.second;
    const ValidationResult result = judgeChanged(loaded, [&](auto& p) { p.joints[motor].*member = 0; });
    const std::vector<NamedCause> found = result.cause ? std::vector<NamedCause>{*result.cause} : result.causes;
    ASSERT_FALSE(found.empty()) << name << ": " << result.cause_words.cause;
    EXPECT_EQ(found.front().kind, CauseKind::missing_term);
    EXPECT_EQ(found.front().parameter, joint + "." + name) << result.cause_words.cause;
  }
}

/// A tie between two points has no armature; one motor is all motors.
TEST(LoopMistake, closuresHaveNoNumbersAndOneMotorIsAll) {
  const Machine machine("fourbar");
  const auto& joints = machine.mechanism().joints();
  const ValidationResult turned = judgeChanged(machine, [&](auto& p) {
    for (MechanismBody& body : p.bodies)
      if (!body.fixed) body.inertia *= 1.1;
  });
  std::vector<NamedCause> all = turned.causes;
  if (turned.cause) all.push_back(*turned.cause);
  for (const NamedCause& each : all)
    for (const MechanismJoint& joint : joints)
      EXPECT_FALSE(joint.closure && each.joint == joint.name) << each.parameter;
  const NamedCause window = named(judgeEfforts(machine,
                                               [](std::size_t i, auto& tau) {
                                                 if (i > 20 && i < 30) tau(0) += 0.1 * static_cast<double>(i % 4 + 1);
                                               }),
                                  CauseKind::window);
  EXPECT_EQ(window.body, "all");
  EXPECT_EQ(window.motor, 0);
}

}  // namespace
}  // namespace ursula
