#include <gtest/gtest.h>

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
  const ValidationResult result = machine.judge(efforts);
  ASSERT_EQ(result.verdict, Verdict::fail);
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::missing_term);
  EXPECT_EQ(result.cause->term, "coriolis");
  EXPECT_EQ(result.cause->body, "all");
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
  const ValidationResult result = machine.judge(machine.efforts(without));
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::missing_term);
  EXPECT_EQ(result.cause->term, "gravity");
  EXPECT_EQ(static_cast<std::size_t>(std::count(result.cause->body.begin(), result.cause->body.end(), ',')) + 1, rods)
      << result.cause->body;
}

TEST(LoopMistake, transmissionOfTheStartIsNamed) {
  const Machine machine("fourbar", loseFriction);
  const OpenMachine open(machine);
  ASSERT_TRUE(open.isPossible());
  MatrixXd N_0, N;
  open.forces(0, true, N_0);
  std::vector<MotorEfforts> efforts;
  for (const double t : machine.instants()) efforts.push_back(N_0.transpose() * open.forces(t, true, N));
  const ValidationResult result = machine.judge(efforts);
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::closure);
  EXPECT_EQ(result.cause->term, "constant");
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
  const ValidationResult result = machine.judge(efforts);
  ASSERT_TRUE(result.cause) << result.cause_words.cause;
  EXPECT_EQ(result.cause->kind, CauseKind::parameter);
  EXPECT_EQ(result.cause->joint, machine.mechanism().motor(0).name);
  EXPECT_EQ(result.cause->parameter, "joint." + result.cause->joint + ".smoothing_speed");
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

}  // namespace
}  // namespace ursula
