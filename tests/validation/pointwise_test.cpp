// Solver and Simbody at the same instants: a right solver passes, and a wrong one fails the proper check.

#include "validation/samples/pointwise.h"
#include "model/instants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "nocsolver/errors.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/validate.h"

namespace ursula {
namespace {

const std::vector<std::string> kinematic_names = {
    "kinematics.joint_angles", "kinematics.joint_rates", "kinematics.joint_accelerations",
    "kinematics.positions",    "kinematics.twists",      "kinematics.accelerations"};
const std::vector<std::string> dynamic_names = {"torque.pointwise", "acceleration.pointwise"};

struct Outcome {
  std::vector<PointwiseSample> samples;
  std::vector<Check> checks;
};

Outcome judge(const Scenario& scenario, const Subject& subject, int instants = 31) {
  Outcome out;
  out.samples = runPointwise(scenario, subject, equallySpaced(scenario.trajectory->duration(), instants));
  out.checks = judgePointwise(out.samples, static_cast<bool>(subject.kinematics));
  return out;
}

class Pointwise : public testing::TestWithParam<std::string> {};

TEST_P(Pointwise, theSolverPasses) {
  const Scenario scenario = vectorScenario(GetParam());
  const Outcome outcome = judge(scenario, solverOf(scenario));
  EXPECT_EQ(others(outcome.checks, Verdict::pass), "");
  for (const std::string& name : kinematic_names) EXPECT_NE(findCheck(outcome.checks, name), nullptr) << name;
  double torque = 0, torque_error = 0, acceleration = 0, acceleration_error = 0;
  for (const PointwiseSample& sample : outcome.samples) {
    torque = std::max(torque, sample.torques.cwiseAbs().maxCoeff());
    torque_error = std::max(torque_error, sample.torque.error);
    acceleration = std::max(acceleration,
                            sample.motion.p_ddot.norm() + sample.conditioning.length * sample.motion.omega_dot.norm());
    acceleration_error = std::max(acceleration_error, sample.acceleration.error);
  }
  std::cout << "relative to the largest: torque " << torque_error / torque << ", acceleration "
            << acceleration_error / acceleration << '\n';
  EXPECT_LE(torque_error, 1e-12 * torque);  // the project's promise
  EXPECT_LE(acceleration_error, 1e-10 * acceleration);
}

TEST_P(Pointwise, torquesOffByABillionthFail) {
  const Scenario scenario = vectorScenario(GetParam());
  const Outcome outcome = judge(scenario, scaledTorques(solverOf(scenario), 1 + 1e-9));
  EXPECT_EQ(firstFailing(outcome.checks), "torque.pointwise");
  for (const std::string& name : kinematic_names) EXPECT_EQ(verdictOf(outcome.checks, name), "pass") << name;
}

INSTANTIATE_TEST_SUITE_P(Machines, Pointwise, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

TEST(PointwiseControl, oneInstantOfMany) {
  const Scenario scenario = vectorScenario("paper-helix");
  const double t = equallySpaced(scenario.trajectory->duration(), 31)[17];
  const Outcome outcome = judge(scenario, changedTorques(solverOf(scenario), [t](const auto& motion, Vector6d tau) {
                                  if (motion.t == t) tau(3) += 1e-3;
                                  return tau;
                                }));
  const Check* torque = findCheck(outcome.checks, "torque.pointwise");
  ASSERT_NE(torque, nullptr);
  EXPECT_EQ(torque->verdict, Verdict::fail);
  EXPECT_NEAR(torque->value, 1e-3, torque->limit);
  EXPECT_NE(torque->why.find("leg 4"), std::string::npos) << torque->why;
  EXPECT_NE(torque->why.find("t = 1.7 s"), std::string::npos) << torque->why;
}

TEST(PointwiseControl, formulasAsPrinted) {
  const Scenario scenario = vectorScenario("random-4");
  const std::vector<std::pair<FormulaError, std::string>> first = {
      {FormulaError::eq14b, "kinematics.joint_angles"},
      {FormulaError::eq15a, "kinematics.joint_rates"},
      {FormulaError::eq19a, "kinematics.joint_accelerations"},
      {FormulaError::eq16, "kinematics.twists"},
      {FormulaError::eq17, "kinematics.accelerations"},
      {FormulaError::eq43b_sigma, "kinematics.accelerations"},
      {FormulaError::drop_platform_centripetal, "kinematics.accelerations"},
      {FormulaError::eq47, "torque.pointwise"},
      {FormulaError::drop_gyroscopic_legs, "torque.pointwise"},
      {FormulaError::drop_friction, "torque.pointwise"}};
  for (const auto& [formula_error, name] : first) {
    const Subject subject = wrongNocSubject(*scenario.manipulator, scenario.load, WithFormulaErrors(formula_error));
    EXPECT_EQ(firstFailing(judge(scenario, subject, 5).checks), name) << "error " << static_cast<int>(formula_error);
  }
}

TEST(PointwiseControl, notANumberFailsEverything) {
  const Scenario scenario = vectorScenario("paper-helix");
  Subject subject = scaledTorques(solverOf(scenario), std::nan(""));
  for (const std::string& name : dynamic_names)
    EXPECT_EQ(verdictOf(judge(scenario, subject, 3).checks, name), "fail") << name;

  subject.kinematics = [](const Motion<double>&) {
    KinematicAnswer answer;
    const Vector6d nan = Vector6d::Constant(std::nan(""));
    answer.joints = {{nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}};
    for (BodyMotion<double>& body : answer.bodies)
      body = {Vector3d::Constant(std::nan("")), Matrix3d::Constant(std::nan("")), nan, nan};
    answer.T = answer.T_rate = Matrix6d::Constant(std::nan(""));
    return answer;
  };
  EXPECT_EQ(others(judge(scenario, subject, 3).checks, Verdict::fail), "");
}

/// One component is NaN among many right ones.
TEST(PointwiseControl, aSingleNotANumberFailsItsCheck) {
  const Scenario scenario = vectorScenario("paper-helix");
  Subject subject = solverOf(scenario);
  const auto right = subject.kinematics;
  subject.kinematics = [right](const Motion<double>& motion) {
    KinematicAnswer answer = right(motion);
    if (motion.t > 1) answer.bodies[3].twist(4) = std::nan("");
    return answer;
  };
  const Outcome outcome = judge(scenario, subject, 5);
  EXPECT_EQ(firstFailing(outcome.checks), "kinematics.twists");
  EXPECT_NE(findCheck(outcome.checks, "kinematics.twists")->why.find("proximal link of leg 4"), std::string::npos);
  EXPECT_EQ(verdictOf(outcome.checks, "kinematics.positions"), "pass");
}

TEST(PointwiseControl, aRefusalFailsWithItsReason) {
  const Scenario scenario = vectorScenario("paper-helix");
  const Subject subject = changedTorques(solverOf(scenario), [](const Motion<double>& motion, const Vector6d& tau) {
    if (motion.t > 1) throw StretchedLeg("is stretched", 2, motion.t, 1e-9, 1e-8, "");
    return tau;
  });
  const Outcome outcome = judge(scenario, subject, 5);
  EXPECT_EQ(others(outcome.checks, Verdict::fail), "");
  for (const Check& check : outcome.checks)
    EXPECT_NE(check.why.find("leg 3 is stretched at t = 1.5 s"), std::string::npos) << check.why;
}

TEST(PointwiseControl, noInstantIsAFailure) {
  EXPECT_EQ(others(judgePointwise({}, true), Verdict::fail), "");
  EXPECT_GE(judgePointwise({}, true).size(), kinematic_names.size() + dynamic_names.size());
}

TEST(PointwiseControl, withoutKinematicsOnlyTorquesAreJudged) {
  const Scenario scenario = vectorScenario("paper-helix");
  Subject subject = solverOf(scenario);
  subject.kinematics = nullptr;
  EXPECT_EQ(judge(scenario, subject, 3).checks.size(), dynamic_names.size());
}

}  // namespace
}  // namespace ursula
