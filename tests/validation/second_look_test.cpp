// Second looks at values beyond their limits: the measurement there, which no model error can hide behind.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/evidence/reference.h"
#include "validation/limits/rounding_profile.h"
#include "validation/replay/observed_order.h"
#include "validation/replay/windows.h"

namespace ursula {
namespace {

class SecondLooks : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
  RoundingProfile profile_{scenario_, 5};
  Motion<double> motion_ = scenario_.trajectory->at(0.37 * scenario_.trajectory->duration());
  Conditioning at_ = profile_.at(motion_);
};

TEST_P(SecondLooks, measureTheInstantItself) {
  const Conditioning closer = profile_.closer(motion_);
  for (std::size_t q = 0; q < rounded_count; ++q) EXPECT_GE(closer.levels[q], at_.levels[q]);
  // This is as if rounding were far smaller everywhere else.
  Conditioning sharp = at_;
  sharp.levels = uniformLevels(1e-9);
  RemeasuredLimits look(profile_);
  const double rounding = closer.rounding(Rounded::torque);
  EXPECT_DOUBLE_EQ(look.limit(0.5 * rounding, sharp, Rounded::torque, motion_), rounding);
  EXPECT_EQ(look.limit(1e-3 * sharp.rounding(Rounded::torque), sharp, Rounded::torque, motion_),
            sharp.rounding(Rounded::torque))
      << "within its limit, nothing is looked at";
}

TEST_P(SecondLooks, areNotTakenAgainOnceAnErrorIsConfirmed) {
  const double rounding = profile_.closer(motion_).rounding(Rounded::torque);
  Conditioning sharp = at_;
  sharp.levels = uniformLevels(1e-9);
  RemeasuredLimits look(profile_);
  EXPECT_LT(look.limit(3 * rounding, sharp, Rounded::torque, motion_), 3 * rounding);
  EXPECT_EQ(look.limit(0.5 * rounding, sharp, Rounded::torque, motion_), sharp.rounding(Rounded::torque));
  RemeasuredLimits other(profile_);
  EXPECT_EQ(other.limit(std::nan(""), sharp, Rounded::torque, motion_), sharp.rounding(Rounded::torque));
}

/// The second look at direct dynamics uses the torques that showed the error.
TEST_P(SecondLooks, knowTheTorquesOfTheDirectDynamics) {
  const Vector6d large = Vector6d::Constant(1e6 * at_.torque_scale);
  EXPECT_GT(profile_.closer(motion_, &large).levels[static_cast<std::size_t>(Rounded::direct)],
            10 * profile_.closer(motion_).levels[static_cast<std::size_t>(Rounded::direct)]);
}

TEST_P(SecondLooks, seeWhatTheStepsOfAReplayAreOffBy) {
  const Reference& reference = *referenceOf(GetParam(), 21);
  const WindowedReplay& window = reference.replays().windows.front();
  ReplayPlan blunt = reference.replays().plan;
  blunt.tolerance = 1e-8;
  const Replay replay =
      ursula::replay(reference.scenario, blunt.torques, settingsOf(reference.scenario, blunt, window.window, 1));
  const double error = (replay.steps.back().position_error - window.replay.steps.back().position_error).norm();
  const IntegrationError seen = closerLook(reference.scenario, blunt, window.window, replay);
  ASSERT_TRUE(seen.measured());
  EXPECT_GT(error, 1e-10);
  EXPECT_GT(integration_safety * seen.steps.back().position, error);
  EXPECT_LT(seen.steps.back().position, 100 * error);
  EXPECT_LT(reference.closer(0).steps.back().position, 1e-3 * seen.steps.back().position) << "the judged one's";
}

INSTANTIATE_TEST_SUITE_P(Scenarios, SecondLooks, testing::Values("paper-helix", "proving-ground", "near-singular"),
                         [](const auto& name) { return asTestName(name.param); });

class Orders : public testing::TestWithParam<std::string> {};

TEST_P(Orders, ofTheJudgedIntegratorIsEightAndAnotherFails) {
  const Reference reference(scenarioOf(GetParam()));  // the motion ends with it
  const Scenario& scenario = reference.scenario;
  const Check right = judgeOrder(observedOrders(scenario)), lower = judgeOrder(observedOrders(scenario, true));
  EXPECT_EQ(right.verdict, Verdict::pass) << right.why;
  EXPECT_THAT(right.why, HasSubstr("stretches"));
  EXPECT_EQ(lower.verdict, Verdict::fail) << lower.why;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Orders,
                         testing::Values("paper-helix", "proving-ground", "millimetres", "near-singular",
                                         "flight-simulator", "hexa"),
                         [](const auto& name) { return asTestName(name.param); });

}  // namespace
}  // namespace ursula
