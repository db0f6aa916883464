// Torques between the samples: torque.between meets a pulse that no sample meets, and says how narrow one may be.

#include "model/instants.h"
#include "validation/checks/judges.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <regex>

#include "nocsolver/errors.h"
#include "tests/support/matchers.h"
#include "tests/support/motions.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/samples/engines.h"
#include "validation/validate.h"

namespace ursula {
namespace {

/// The helix with its right torques, sampled once for all tests.
struct RightHelix {
  Scenario scenario = scenarioOf("paper-helix");
  RoundingProfile profile{scenario, 31};
  Subject solver = solverOf(scenario);
  std::vector<double> instants = equallySpaced(3, 301);
  std::vector<PointwiseSample> samples = runPointwise(scenario, solver, instants, profile);
};

const RightHelix& rightHelix() {
  static const RightHelix once;
  return once;
}

class Between : public testing::Test {
 protected:
  Check judge(const Subject& subject) const { return judgeBetween(scenario_, subject, samples_, profile_); }
  /// Right torques with a pulse on leg 3 over [from, from + length).
  Subject pulsed(double from, double length, double size) const {
    return changedTorques(right_, [from, length, size](const Motion<double>& motion, Vector6d torques) {
      if (motion.t >= from && motion.t < from + length) torques(2) += size;
      return torques;
    });
  }

  const Scenario& scenario_ = rightHelix().scenario;
  const RoundingProfile& profile_ = rightHelix().profile;
  const Subject& right_ = rightHelix().solver;
  const std::vector<double>& instants_ = rightHelix().instants;
  const std::vector<PointwiseSample>& samples_ = rightHelix().samples;

  /// The verdict on the right torques, which several tests need.
  const Check& ofRight() const {
    static const Check once = judge(right_);
    return once;
  }
};

TEST_F(Between, rightTorquesPass) {
  const Check& check = ofRight();
  EXPECT_EQ(check.verdict, Verdict::pass) << check.why;
  EXPECT_LT(check.limit, 1e-10 * largestTorque(samples_)) << "the limit says little";
  EXPECT_THAT(check.why, HasSubstr("at 10239 instants"));
}

/// No other check of torques sees a millisecond of a quarter of a million newton metres between two samples.
TEST_F(Between, aPulseBetweenTheSamplesFailsThereAlone) {
  const Subject subject = pulsed(1.2345, 1e-3, 2.5e5);
  const auto samples = runPointwise(scenario_, subject, instants_, profile_);
  std::vector<Check> checks = judgePointwise(samples, true);
  for (Check& engine : judgeEngines(runEngines(scenario_, samples, profile_))) checks.push_back(std::move(engine));
  EXPECT_EQ(others(checks, Verdict::pass), "");
  EXPECT_NE(findCheck(checks, "torque.twin"), nullptr);
  const Check check = judge(subject);
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_NEAR(check.largest.value, 2.5e5, 1);
  EXPECT_NEAR(check.largest.t, 1.235, 6e-4);
  EXPECT_EQ(check.largest.where, "leg 3");
}

TEST_F(Between, theNarrowestPulseSeenIsWhatItSays) {
  const std::string& why = ofRight().why;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(why, found, std::regex("longer than ([0-9.e-]+) s and larger than ([0-9.e-]+) N m")))
      << why;
  const double length = std::stod(found[1]), size = std::stod(found[2]);
  EXPECT_LT(length, 1e-3);
  EXPECT_LT(size, 1e-5);
  EXPECT_NEAR(ofRight().gap, length, 0.01 * length) << "the same as a number";
  SeededDraws dice(3);
  int missed = 0;
  for (int k = 0; k < 4; ++k) {
    const double from = dice.between(0, 3 - length);
    EXPECT_EQ(judge(pulsed(from, 1.0001 * length, 2 * size)).verdict, Verdict::fail) << from;
    missed += judge(pulsed(from, 0.02 * length, 2 * size)).verdict == Verdict::pass ? 1 : 0;
  }
  EXPECT_GT(missed, 0) << "far narrower ones are seen: the number says too little";
}

/// The result is the same in other units.
TEST_F(Between, saysSoInSeconds) {
  const FrameChange natural = naturalFrameChange(scenario_);
  const Scenario there = natural.transformed(scenario_);
  const RoundingProfile profile(there, 5);
  const Subject subject = nocSubject(*there.manipulator, there.load);
  const double end = there.trajectory->duration();
  const auto samples = runPointwise(there, subject, equallySpaced(end, 5), profile);
  const auto pulse = [](const std::string& why) { return why.substr(why.find("a pulse longer"), 28); };
  EXPECT_EQ(pulse(judgeBetween(there, subject, samples, profile, natural.units).why), pulse(ofRight().why));
}

TEST_F(Between, seesWhatIsWrongEverywhere) { EXPECT_EQ(judge(scaledTorques(right_, 1 + 1e-9)).verdict, Verdict::fail); }

/// All answers are judged, not only those to the check's own questions.
TEST_F(Between, everyAnswerIsJudged) {
  Subject late = right_;
  late.torques = [right = right_.torques, calls = 0](const Motion<double>& motion) mutable {
    return Vector6d((++calls > 100 ? 1 + 1e-9 : 1) * right(motion));
  };
  const Subject subject = recorded(late);
  const auto ask = [&](int count) {
    for (int k = 0; k < count; ++k) subject.torques(scenario_.trajectory->at(3 * std::fmod(k * 0.618, 1.0)));
  };
  ask(100);
  ASSERT_EQ(subject.answers().size(), 100u);
  EXPECT_EQ(judgeAnswers(scenario_, subject.answers(), samples_, profile_, {}).verdict, Verdict::pass);
  ask(5);
  ASSERT_EQ(subject.answers().size(), 105u);
  EXPECT_EQ(judgeAnswers(scenario_, subject.answers(), samples_, profile_, {}).verdict, Verdict::fail);
}

TEST_F(Between, aSolverThatIsWrongLaterOnFailsTheValidation) {
  Subject late = right_;
  late.formulation = Formulation::external;
  late.rebuilt = nullptr;
  const auto calls = std::make_shared<int>(0);
  late.torques = [right = right_.torques, calls](const Motion<double>& motion) {
    return Vector6d((++*calls > 13000 ? 1.001 : 1) * right(motion));
  };
  const ValidationResult result = validate(scenario_, late);
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_GT(*calls, 13000) << "it was never wrong";
  EXPECT_EQ(findCheck(result.checks, "torque.between")->verdict, Verdict::fail);
}

TEST_F(Between, noNumberIsNoAgreement) {
  EXPECT_EQ(judge(pulsed(2, 1e-3, std::nan(""))).verdict, Verdict::fail);
  EXPECT_EQ(judge(pulsed(0, 3.1, std::nan(""))).verdict, Verdict::fail);
}

TEST_F(Between, aRefusalFailsWithItsReason) {
  Subject refusing = right_;
  refusing.torques = [right = right_.torques](const Motion<double>& motion) {
    if (motion.t > 2) throw StretchedLeg("is stretched", 2, motion.t, 1e-9, 1e-8, "");
    return right(motion);
  };
  const Check check = judge(refusing);
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_EQ(check.reason, Reason::not_made);
  EXPECT_THAT(check.why, HasSubstr("leg 3 is stretched"));
}

TEST_F(Between, noSampleFails) { EXPECT_EQ(judgeBetween(scenario_, right_, {}, profile_).verdict, Verdict::fail); }

}  // namespace
}  // namespace ursula
