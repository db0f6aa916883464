// Where a solver or a kernel is wrong: said where it shows, and no cause is named that does not fit.

#include "parts/causes/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "parts/fast/fast_checks.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"

namespace ursula {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int samples = 31;

class FastBatches : public testing::Test {
 protected:
  static std::vector<Check> judge(const FastFault& fault) {
    const Scenario scenario = scenarioOf("paper-helix", samples);
    static const std::vector<PointwiseSample> at = rightSamples(scenario, samples);
    return judgeFast(runFast(scenario, Units{}, at, fault), at, Units{});
  }
  /// Changes the efforts in a batch from pose `first` on, counted from 0, to before `end`.
  static FastFault wrong(std::size_t first, std::size_t end) {
    FastFault fault;
    fault.answers = [first, end](FastAnswers& answers) {
      for (std::size_t k = first; k < std::min(end, answers.torques_in_batch.size()); ++k)
        answers.torques_in_batch[k] *= 1 + 1e-6;
    };
    return fault;
  }
};

TEST_F(FastBatches, areJudgedToTheirEnd) {
  EXPECT_EQ(others(judge({}), Verdict::pass), "");
  for (const std::size_t first : {5000, 32000}) {
    const std::vector<Check> checks = judge(wrong(first, SIZE_MAX));
    EXPECT_EQ(verdictOf(checks, "fast.inverse_batch"), "fail");
    EXPECT_EQ(verdictOf(checks, "fast.inverse"), "pass");
    EXPECT_THAT(findCheck(checks, "fast.inverse_batch")->why,
                HasSubstr("from number " + std::to_string(first + 1) + " on"));
  }
  EXPECT_THAT(findCheck(judge(wrong(7000, 7003)), "fast.inverse_batch")->why,
              HasSubstr("; 3 of 32771 answers are wrong, the first is number 7001"));
  EXPECT_THAT(findCheck(judge(wrong(0, SIZE_MAX)), "fast.inverse_batch")->why, Not(HasSubstr("answers are wrong")));
}

/// A number that looks random, from 0 to 1, the same for the same motion.
double drawOf(const Motion<double>& motion) {
  std::uint64_t bits = 0;
  const double sum = motion.p.sum() + motion.p_ddot.sum() + motion.t;
  std::memcpy(&bits, &sum, sizeof bits);
  bits ^= bits >> 31U;
  bits *= 0x9E3779B97F4A7C15U;
  bits ^= bits >> 29U;
  bits *= 0xBF58476D1CE4E5B9U;
  bits ^= bits >> 32U;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

class Places : public testing::Test {
 protected:
  Scenario scenario_ = scenarioOf("paper-helix", samples);
  /// The result for a solver from outside.
  ValidationResult judge(const TorqueChange& change) const {
    Subject subject = changedTorques(torquesAlone(scenario_), change);
    subject.formulation = Formulation::external;
    return validate(scenario_, subject, {false, false, false, referenceOf("paper-helix", samples)});
  }
  bool isSample(double t) const {
    const double k = t / scenario_.trajectory->duration() * (samples - 1);
    return std::abs(k - std::round(k)) < 1e-9;
  }
};

Vector6d offOnFirst(const Vector6d& torques) { return torques + 10 * Vector6d::Unit(0); }

TEST_F(Places, ofASolverThatIsWrongAtTheSamplesOnlyAreSaidAndNoCause) {
  const ValidationResult result = judge([&](const Motion<double>& motion, const Vector6d& torques) {
    return isSample(motion.t) ? offOnFirst(torques) : torques;
  });
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_FALSE(result.cause);
  EXPECT_TRUE(result.causes.empty());
  EXPECT_EQ(result.cause_words.claim, CauseClaim::none);
  EXPECT_THAT(result.cause_words.cause, HasSubstr("wrong at all 31 samples and at none of "));
  EXPECT_THAT(result.cause_words.off, HasSubstr("leg 1"));
}

TEST_F(Places, ofASolverThatIsWrongBetweenTheSamplesAreSaid) {
  const ValidationResult result = judge([&](const Motion<double>& motion, const Vector6d& torques) {
    return !isSample(motion.t) && drawOf(motion) < 1.0 / 2000 ? offOnFirst(torques) : torques;
  });
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_FALSE(result.cause);
  EXPECT_THAT(result.cause_words.off, HasSubstr("leg 1 by up to 10 N m at t = "));
  EXPECT_THAT(result.cause_words.cause, HasSubstr("wrong at none of 31 samples and at "));
  EXPECT_THAT(result.cause_words.cause, HasSubstr("those from t = "));
  EXPECT_THAT(findCheck(result.checks, "torque.between")->off, HasSubstr("wrong at none of 31 samples"));
}

/// The negative control: an error that is the same at every instant keeps its cause.
TEST_F(Places, ofASolverThatIsWrongEverywhereAreNone) {
  const ValidationResult result = judge([](const auto&, const Vector6d& torques) { return offOnFirst(torques); });
  ASSERT_TRUE(result.cause);
  EXPECT_EQ(result.cause->kind, CauseKind::offset);
  EXPECT_THAT(result.cause_words.cause, Not(HasSubstr("samples")));
}

TEST_F(Places, noiseOnOneMotorIsNoLackOfDigits) {
  const auto noisy = [](int motors) -> TorqueChange {
    return [motors](const Motion<double>& motion, const Vector6d& torques) {
      Vector6d out = torques;
      for (int i = 0; i < motors; ++i) {
        Motion<double> other = motion;
        other.t += i;
        out(i) += 1e-3 * (drawOf(other) - 0.5);
      }
      return out;
    };
  };
  const ValidationResult one = judge(noisy(1));
  EXPECT_EQ(one.verdict, Verdict::fail);
  EXPECT_FALSE(one.cause) << one.cause_words.cause;
  EXPECT_THAT(one.cause_words.cause, Not(HasSubstr("digits, within")));
  EXPECT_THAT(one.cause_words.cause, HasSubstr("noise"));
  const ValidationResult all = judge(noisy(6));
  ASSERT_TRUE(all.cause);
  EXPECT_EQ(all.cause->kind, CauseKind::digits);
}

}  // namespace
}  // namespace ursula
