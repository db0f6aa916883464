// Symmetries need no reference. The solver has all of them, and a solver that lacks one fails its check.

#include "validation/checks/judges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nocsolver/errors.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

const std::vector<std::string> names = {"invariance.rotation", "invariance.labels", "invariance.mass",
                                        "invariance.time_reversal"};
constexpr int instants = 7;

/// The torques that a wrong solver adds to the right ones.
using Extra = std::function<Vector6d(const Manipulator& machine, const Motion<double>& motion)>;

/// A solver that is wrong in the same way for every machine.
Subject broken(const Extra& extra) {
  Subject subject;
  subject.name = "broken";
  subject.rebuilt = [extra](const Manipulator& machine) {
    Subject wrong = nocSubject(machine, nullptr);
    wrong.torques = [right = wrong.torques, extra, machine](const Motion<double>& motion) {
      return Vector6d(right(motion) + extra(machine, motion));
    };
    return wrong;
  };
  return subject;
}

std::vector<Check> judge(const Scenario& scenario, const Subject& subject) {
  const std::vector<PointwiseSample> samples = rightSamples(scenario, instants);
  return judgeInvariances(runInvariances(scenario, subject, samples), samples, RoundingProfile(scenario, instants));
}

class SolverInvariance : public testing::TestWithParam<std::string> {};

TEST_P(SolverInvariance, isWhole) {
  const Scenario scenario = scenarioOf(GetParam());
  const std::vector<PointwiseSample> samples = rightSamples(scenario, instants);
  const std::vector<Check> checks = judgeInvariances(runInvariances(scenario, solverOf(scenario), samples), samples,
                                                     RoundingProfile(scenario, instants));
  for (const std::string& name : names) EXPECT_EQ(verdictOf(checks, name), "pass") << others(checks, Verdict::pass);
  // In the other symmetries sums may be equal to the last bit.
  EXPECT_GT(findCheck(checks, "invariance.rotation")->value, 0) << "nothing was turned";
  for (const Check& check : checks) EXPECT_LT(check.limit, 1e-10 * largestTorque(samples)) << check.name;
}

INSTANTIATE_TEST_SUITE_P(Machines, SolverInvariance,
                         testing::Values("paper-helix", "random-2", "random-5", "proving-ground"),
                         [](const auto& name) { return asTestName(name.param); });

struct Defect {
  const char* breaks;
  Extra extra;
};

double massOf(const Manipulator& machine) { return machine.platform().mass; }

/// Each defect breaks one symmetry and keeps the others: it scales with the mass, and knows no direction of the world,
/// no leg's number and no sense of time.
const std::vector<Defect> defects = {
    {"invariance.rotation",
     [](const Manipulator& machine, const Motion<double>& motion) {
       return Vector6d::Constant(1e-9 * massOf(machine) * motion.p.z());
     }},
    {"invariance.labels", [](const Manipulator& machine,
                             const Motion<double>&) { return Vector6d(1e-9 * massOf(machine) * Vector6d::Unit(2)); }},
    {"invariance.mass", [](const Manipulator&, const Motion<double>&) { return Vector6d::Constant(5e-7); }},
    {"invariance.time_reversal", [](const Manipulator& machine, const Motion<double>& motion) {
       return Vector6d::Constant(1e-8 * massOf(machine) * motion.p.dot(motion.p_dot));
     }}};

class BrokenInvariance : public testing::TestWithParam<std::string> {};

TEST_P(BrokenInvariance, failsAlone) {
  const Scenario scenario = scenarioOf(GetParam());
  for (const Defect& defect : defects) {
    const std::vector<Check> checks = judge(scenario, broken(defect.extra));
    for (const std::string& name : names)
      EXPECT_EQ(verdictOf(checks, name), name == defect.breaks ? "fail" : "pass") << "broken: " << defect.breaks;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, BrokenInvariance, testing::Values("paper-helix", "random-2", "random-5"),
                         [](const auto& name) { return asTestName(name.param); });

/// Time reversal detects such friction on a machine that has friction.
TEST(Invariance, frictionThatDoesNotTurnWithTheMotionFails) {
  const Extra extra = [](const Manipulator& machine, const Motion<double>& motion) {
    Vector6d out;
    for (int i = 0; i < leg_count; ++i) out(i) = 1e-7 * machine.leg(i).friction.phi * motion.p_dot.norm();
    return out;
  };
  const std::vector<Check> checks = judge(scenarioOf("random-5"), broken(extra));
  for (const std::string& name : names)
    EXPECT_EQ(verdictOf(checks, name), name == "invariance.time_reversal" ? "fail" : "pass") << name;
  EXPECT_EQ(others(judge(scenarioOf("paper-helix"), broken(extra)), Verdict::pass), "") << "there is no friction";
}

/// The limit depends on the torque at the instant, not on the motion's largest.
TEST(Invariance, anErrorAtOneInstantFailsAndIsPlaced) {
  const Extra extra = [](const Manipulator&, const Motion<double>& motion) {
    return Vector6d::Constant(std::abs(motion.t - 1) < 0.01 ? 1e-6 : 0);
  };
  const std::vector<Check> checks = judge(scenarioOf("paper-helix"), broken(extra));
  const Check* mass = findCheck(checks, "invariance.mass");
  ASSERT_NE(mass, nullptr);
  EXPECT_EQ(mass->verdict, Verdict::fail);
  EXPECT_THAT(mass->why, testing::HasSubstr("t = 1 s"));
}

TEST(Invariance, noNumberIsNotTheSameAsNoNumber) {
  for (int leg = 0; leg < leg_count; ++leg) {
    const std::vector<Check> checks =
        judge(scenarioOf("paper-helix"), broken([leg](const Manipulator&, const Motion<double>&) {
                Vector6d extra = Vector6d::Zero();
                extra(leg) = std::numeric_limits<double>::quiet_NaN();
                return extra;
              }));
    for (const std::string& name : names) EXPECT_EQ(verdictOf(checks, name), "fail") << name << ", leg " << leg + 1;
  }
}

TEST(Invariance, aRefusalFailsWithItsReason) {
  const std::vector<Check> checks =
      judge(scenarioOf("paper-helix"), broken([](const Manipulator&, const Motion<double>& motion) -> Vector6d {
              throw SingularJacobian("B is singular, its smallest pivot over its largest", -1, motion.t, 0, 1e-15, "");
            }));
  for (const std::string& name : names) {
    ASSERT_EQ(verdictOf(checks, name), "fail") << name;
    EXPECT_THAT(findCheck(checks, name)->why, testing::HasSubstr("B is singular"));
  }
}

TEST(Invariance, noInstantFails) {
  const Scenario scenario = scenarioOf("paper-helix");
  const std::vector<Check> checks =
      judgeInvariances(runInvariances(scenario, solverOf(scenario), {}), {}, RoundingProfile(scenario, instants));
  for (const std::string& name : names) EXPECT_EQ(verdictOf(checks, name), "fail") << name;
}

TEST(Invariance, isNotAskedOfWhatIsNoSolver) {
  const Scenario scenario = scenarioOf("paper-helix");
  Subject torques_alone = solverOf(scenario);
  torques_alone.rebuilt = nullptr;
  EXPECT_TRUE(judge(scenario, torques_alone).empty());
}

}  // namespace
}  // namespace ursula
