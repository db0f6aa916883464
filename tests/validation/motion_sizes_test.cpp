// Scales come from the whole motion: where the samples are at rest, a right machine passes, a wrong one fails, and what
// compares nothing with nothing is not held.

#include "validation/limits/motion_sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <utility>

#include "model/instants.h"
#include "tests/support/changed.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/replay/windows.h"

namespace ursula {
namespace {

using testing::HasSubstr;

const char* const rates[] = {"kinematics.joint_rates",
                             "kinematics.joint_accelerations",
                             "kinematics.twists",
                             "kinematics.accelerations",
                             "kinematics.jacobian",
                             "kinematics.jacobian_rate",
                             "kinematics.jacobian_difference"};

Scenario withoutGravity(const std::string& name, int samples) {
  return changed(scenarioOf(name, samples), [](ManipulatorParameters& machine) { machine.gravity.setZero(); });
}

/// The scenario with its times in ms instead of s.
Scenario hasty(const std::string& name, int samples) {
  const std::filesystem::path file = std::filesystem::path(URSULA_SCENARIOS) / (name + ".toml");
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  Scenario out = parseScenario(std::regex_replace(text.str(), std::regex("time = ([0-9.]+)"), "time = $1e-3"), file);
  out.simulation.samples = samples;
  return out;
}

/// A solver whose first motor is off by `error` at the start alone.
Subject offAtStart(const Scenario& scenario, double error) {
  return changedTorques(torquesAlone(scenario), [error](const Motion<double>& motion, const Vector6d& torques) {
    return Vector6d(motion.t == 0 ? torques + error * Vector6d::Unit(0) : torques);
  });
}

TEST(MotionSizes, allowOneRoundingOfTheMotionsSizeAtRestAndNoMore) {
  const Scenario scenario = withoutGravity("flight-simulator", 21);
  ASSERT_EQ(solverOf(scenario).torques(scenario.trajectory->at(0)).norm(), 0) << "no effort at the start";
  const MotionSizes sizes(scenario);
  const double floor = sizes.floors()[static_cast<std::size_t>(Rounded::torque)];
  EXPECT_EQ(floor, std::numeric_limits<double>::epsilon() * sizes.of(Rounded::torque));
  EXPECT_GT(floor, 1e-14);
  EXPECT_LT(floor, 1e-10);
  ValidationOptions options{false, false, false, makeReference(scenario)};
  EXPECT_EQ(others(validate(scenario, offAtStart(scenario, 1e-20), options).checks, Verdict::pass), "");
  const std::vector<Check> checks = validate(scenario, offAtStart(scenario, 2 * floor), options).checks;
  for (const char* check : {"torque.pointwise", "torque.twin", "torque.maximal"})
    EXPECT_EQ(verdictOf(checks, check), "fail") << check;
}

TEST(MotionSizes, areThoseOfMotionsThatRestAtRegularInstantsOrMoveBriefly) {
  const Scenario slow = withoutGravity("waypoints", 2);
  const MotionSizes sizes(slow);
  for (const Rounded quantity : {Rounded::twists, Rounded::twist_rates, Rounded::torque, Rounded::reactions})
    EXPECT_GT(sizes.of(quantity), 0);
  const std::vector<double> telling = tellingInstants(slow);
  EXPECT_TRUE(std::is_sorted(telling.begin(), telling.end()));
  double fastest = 0, told = 0;
  for (const double t : equallySpaced(slow.trajectory->duration(), 1000))
    fastest = std::max(fastest, slow.trajectory->at(t).p_dot.norm());
  for (const double t : telling) told = std::max(told, slow.trajectory->at(t).p_dot.norm());
  EXPECT_GT(told, 0.9 * fastest);
}

class AtRest : public testing::TestWithParam<std::pair<const char*, bool>> {
 protected:
  /// Judged at its two ends at rest: with gravity in a thousandth of the time, or in its time without gravity.
  static Scenario scenario() {
    return GetParam().second ? hasty(GetParam().first, 2) : withoutGravity(GetParam().first, 2);
  }
};

TEST_P(AtRest, nothingThatIsRightFailsAndNothingIsHeldThatWasNotSeen) {
  const ValidationResult result = validate(scenario(), ValidationOptions{true, true, false});
  EXPECT_EQ(firstFailing(result.checks), "(none)") << others(result.checks, Verdict::pass);
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_EQ(verdictOf(result.checks, "feedback.torque"), "pass");
  EXPECT_EQ(verdictOf(result.checks, "torque.between"), "pass");
  EXPECT_EQ(verdictOf(result.checks, "kinematics.positions"), "pass");
  for (const char* name : {"kinematics.joint_rates", "kinematics.twists", "kinematics.jacobian"}) {
    const Check* check = findCheck(result.checks, name);
    EXPECT_EQ(check->verdict, Verdict::inconclusive) << name;
    EXPECT_EQ(check->reason, Reason::not_covered) << name;
    EXPECT_THAT(check->why, HasSubstr("not covered, since nothing moves")) << name;
  }
  EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), GetParam().second ? "pass" : "inconclusive");
}

TEST_P(AtRest, aMillionthTooMuchFailsBetweenTheSamples) {
  const Scenario here = scenario();
  const std::vector<Check> checks =
      validate(here, scaledTorques(solverOf(here), 1 + 1e-6), ValidationOptions{false, false, false}).checks;
  EXPECT_EQ(verdictOf(checks, "torque.between"), "fail");
  EXPECT_EQ(verdictOf(checks, "feedback.torque"), "fail");
}

INSTANTIATE_TEST_SUITE_P(Scenarios, AtRest,
                         testing::Values(std::pair("hexa", false), std::pair("hexaglide", false),
                                         std::pair("three-legs", false), std::pair("hexa", true)),
                         [](const auto& each) {
                           return asTestName(each.param.first) + (each.param.second ? "_hasty" : "");
                         });

TEST(HeldPose, hasNoRatesToHoldButEffortsToJudge) {
  const ValidationResult result = validate(scenarioOf("hold", 5), ValidationOptions{true, true, false});
  EXPECT_EQ(result.verdict, Verdict::pass);
  for (const char* name : rates) {
    const Check* check = findCheck(result.checks, name);
    EXPECT_EQ(check->verdict, Verdict::not_applicable) << name;
    EXPECT_EQ(check->reason, Reason::not_covered) << name;
    EXPECT_EQ(check->why, "not covered, since nothing moves") << name;
  }
  for (const char* name : {"kinematics.positions", "torque.pointwise", "feedback.torque"})
    EXPECT_EQ(verdictOf(result.checks, name), "pass") << name;
}

TEST(HeldPose, withRatesIsWrong) {
  const Scenario scenario = scenarioOf("hold", 5);
  Subject subject = solverOf(scenario);
  subject.kinematics = [right = subject.kinematics](const Motion<double>& motion) {
    KinematicAnswer out = right(motion);
    out.joints.q_dot.phi(2) += 1e-12;
    return out;
  };
  const std::vector<Check> checks = validate(scenario, subject, ValidationOptions{false, false, false}).checks;
  EXPECT_EQ(verdictOf(checks, "kinematics.joint_rates"), "fail");
}

TEST(HeldPose, withoutAnyEffortIsUndecided) {
  const ValidationResult result = validate(withoutGravity("hold", 5), ValidationOptions{true, true, false});
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  for (const char* name : {"torque.pointwise", "torque.twin", "torque.between", "feedback.torque"}) {
    const Check* check = findCheck(result.checks, name);
    EXPECT_EQ(check->verdict, Verdict::inconclusive) << name;
    EXPECT_THAT(check->why, HasSubstr("no effort is needed")) << name;
  }
}

TEST(MovingSamples, coverEveryCheck) {
  const ValidationResult result = validate(scenarioOf("waypoints", 21), ValidationOptions{false, true, false});
  EXPECT_EQ(others(result.checks, Verdict::pass), "");
  for (const char* name : rates) EXPECT_EQ(verdictOf(result.checks, name), "pass") << name;
}

}  // namespace
}  // namespace ursula
