// The stabilised replay: right torques need no help; wrong ones need as much as their error.

#include "validation/replay/stabilised_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/support/vectors.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/replay/windows.h"
#include "validation/validate.h"

namespace ursula {
namespace {

/// The check of the NOC's torques after a change.
class Witness {
 public:
  explicit Witness(const std::string& name) : scenario_(vectorScenario(name)), amplification_(linearised(scenario_)) {
    samples_ = rightSamples(scenario_, 21);
  }

  Check judge(const TorqueChange& change) const {
    const Subject subject = changedTorques(solverOf(scenario_), change);
    return judgeStabilised(stabilisedReplay(scenario_, subject, amplification_, samples_), largest());
  }

  double largest() const { return largestTorque(samples_); }
  double duration() const { return scenario_.trajectory->duration(); }

 private:
  Scenario scenario_;
  Amplification amplification_;
  std::vector<PointwiseSample> samples_;
};

class Feedback : public testing::TestWithParam<std::string> {};

TEST_P(Feedback, exactTorquesNeedNoHelp) {
  const Witness witness(GetParam());
  const Check check = witness.judge([](const Motion<double>&, const Vector6d& torques) { return torques; });
  EXPECT_EQ(check.verdict, Verdict::pass) << check.why;
  EXPECT_GT(check.value, 0);
  EXPECT_LT(check.limit, 1e-10 * witness.largest()) << "the limit says little";
}

TEST_P(Feedback, answersALastingErrorWithItsSize) {
  const Witness witness(GetParam());
  const double wrong = 1e-7 * witness.largest();
  const Check check = witness.judge([wrong](const Motion<double>&, const Vector6d& torques) {
    return Vector6d(torques + wrong * Vector6d::Unit(2));
  });
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_GT(check.value, 0.5 * wrong);
  EXPECT_LT(check.value, 3 * wrong);  // the factor is 4/3 along a mode, and modes mix legs
}

INSTANTIATE_TEST_SUITE_P(Machines, Feedback, testing::Values("paper-helix", "random-2", "random-3", "random-5"),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

TEST(FeedbackWitness, seesAnErrorBetweenTheInstantsThatPointwiseChecksLookAt) {
  const Witness witness("paper-helix");
  const double middle = 0.5 * witness.duration(), width = 0.02 * witness.duration();
  const Check check = witness.judge([&](const Motion<double>& motion, const Vector6d& torques) {
    const double s = (motion.t - middle - width) / width;
    return Vector6d(torques + 1e-6 * witness.largest() * std::exp(-s * s) * Vector6d::Ones());
  });
  EXPECT_EQ(check.verdict, Verdict::fail);
}

TEST(FeedbackWitness, torquesThatLoseTheMachineFail) {
  const Check check =
      Witness("paper-helix").judge([](const Motion<double>&, const Vector6d& torques) { return Vector6d(-torques); });
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_THAT(check.why, testing::HasSubstr("t = "));
}

TEST(FeedbackWitness, aStageOutOfTheMachinesReachIsARejectedStep) {
  const Check check = Witness("paper-helix").judge([](const Motion<double>&, const Vector6d& torques) {
    return Vector6d(-1e6 * torques);
  });
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_TRUE(std::isfinite(check.value)) << check.why;
  EXPECT_THAT(check.why, testing::HasSubstr("the machine was lost at t = "));
}

TEST(FeedbackWitness, torquesThatAreNoNumbersFail) {
  const Check check = Witness("paper-helix").judge([](const Motion<double>&, const Vector6d&) {
    return Vector6d(Vector6d::Constant(std::numeric_limits<double>::quiet_NaN()));
  });
  EXPECT_EQ(check.verdict, Verdict::fail);
}

/// Friction slows a fall but holds nothing, so the stabilising term must be as stiff with friction as without.
TEST(FeedbackWitness, isAsStiffWithFrictionAsWithout) {
  Scenario scenario = scenarioOf("hold");
  const Amplification free(scenario, 10);
  ManipulatorParameters machine = scenario.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.friction.phi = 3000;
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  const Amplification slowed(scenario, 10);
  const auto growth = [](const Amplification& of) {
    return of
        .window(
            0, [](double) { return 0.0; }, 0, std::numeric_limits<double>::max())
        .growth.back();
  };
  EXPECT_LT(growth(slowed), 0.1 * growth(free)) << "friction changes nothing here";
  EXPECT_GT(free.growthRate(1), 1);
  EXPECT_NEAR(slowed.growthRate(1) / free.growthRate(1), 1, 1e-6);
}

}  // namespace
}  // namespace ursula
