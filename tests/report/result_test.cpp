#include "validation/verdict/result.h"
#include "tests/support/numbers.h"
#include "validation/verdict/effort_words.h"
#include "validation/verdict/worst_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ursula {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Verdict verdictOf(double value, double limit) { return judged("name", value, limit, "m", "basis", "why").verdict; }

TEST(Judged, acceptsUpToAndIncludingTheLimit) {
  EXPECT_EQ(verdictOf(1, 1), Verdict::pass);
  EXPECT_EQ(verdictOf(0, 0), Verdict::pass);
  EXPECT_EQ(verdictOf(std::nextafter(1.0, 2.0), 1), Verdict::fail);
}

TEST(Judged, neverAcceptsWhatIsNotFinite) {
  EXPECT_EQ(verdictOf(nan, 1), Verdict::fail);
  EXPECT_EQ(verdictOf(1, nan), Verdict::fail);
  EXPECT_EQ(verdictOf(1, infinite), Verdict::fail);
  EXPECT_EQ(verdictOf(-infinite, 1), Verdict::fail);
}

TEST(Judged, keepsItsTexts) {
  const Check check = judged("group.what", 2, 3, "m", "a basis", "a finding");
  EXPECT_EQ(check.name, "group.what");
  EXPECT_EQ(check.value, 2);
  EXPECT_EQ(check.limit, 3);
  EXPECT_EQ(check.unit, "m");
  EXPECT_EQ(check.basis, "a basis");
  EXPECT_EQ(check.why, "a finding");
}

TEST(NotMade, failsWithoutNumbers) {
  const Check check = notMade("name", "m", "no channel");
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_TRUE(std::isnan(check.value));
  EXPECT_EQ(check.why, "no channel");
}

TEST(NotJudgeable, isInconclusiveEvenWithinItsLimitAndSaysWhy) {
  for (const Reason reason : {Reason::limit_useless, Reason::unfinished, Reason::not_covered}) {
    const Check check = notJudgeable(reason, "name", 0, 1, "m", "basis", "why");
    EXPECT_EQ(check.verdict, Verdict::inconclusive);
    EXPECT_EQ(check.reason, reason);
  }
}

TEST(Reasons, areOfWhatWasNotJudged) {
  EXPECT_EQ(judged("name", 0, 1, "m", "", "").reason, Reason::none);
  EXPECT_EQ(judged("name", 2, 1, "m", "", "").reason, Reason::none) << "a failure of the value's";
  EXPECT_EQ(notMade("name", "m", "").reason, Reason::not_made);
  EXPECT_STREQ(name(Reason::none), "none");
  EXPECT_STREQ(name(Reason::limit_useless), "limit_useless");
  EXPECT_STREQ(name(Reason::unfinished), "unfinished");
  EXPECT_STREQ(name(Reason::not_covered), "not_covered");
  EXPECT_STREQ(name(Reason::not_made), "not_made");
}

TEST(JudgedIfUseful, isInconclusiveOnlyBetweenWhatIsUsefulAndTheDerivedLimit) {
  const auto check = [](double value, double limit) {
    WorstShare worst;
    worst.add(value, limit, 0);
    return judgedIfUseful({"name", "m", 1e6}, worst, "basis", "why", "the cause");  // values above 1 matter
  };
  EXPECT_EQ(check(0.5, 0.9).verdict, Verdict::pass);
  EXPECT_EQ(check(0.5, 0.9).reason, Reason::none);
  EXPECT_EQ(check(0.5, 0.9).limit, 0.9);
  EXPECT_DOUBLE_EQ(check(0.5, 0.9).missed, 0.9e-6);
  EXPECT_EQ(check(0.5, 2).verdict, Verdict::pass) << "a wide limit is a note";
  EXPECT_EQ(check(0.5, 2).limit, 1) << "no check passes with a limit wider than is useful";
  EXPECT_DOUBLE_EQ(check(0.5, 2).missed, 1e-6);
  EXPECT_NE(check(0.5, 2).why.find("the cause"), std::string::npos);
  EXPECT_EQ(check(0.5, 0.9).why, "why");
  EXPECT_EQ(check(1.5, 2).verdict, Verdict::inconclusive);
  EXPECT_EQ(check(1.5, 2).reason, Reason::limit_useless);
  EXPECT_EQ(check(3, 2).verdict, Verdict::fail) << "beyond the derived limit, however wide";
  EXPECT_EQ(check(0.5, infinite).verdict, Verdict::inconclusive) << "no limit was found";
  EXPECT_EQ(check(3, 1).verdict, Verdict::fail);
  EXPECT_EQ(check(nan, 2).verdict, Verdict::fail);
  EXPECT_EQ(check(0.5, nan).verdict, Verdict::fail);
}

TEST(WorstShare, showsTheValueNearestToTheLesserOfLimitAndUse) {
  WorstShare worst;
  worst.add(0.5, 100, 1, 1);  // a wide limit, above the threshold of 1
  worst.add(0.2, 0.8, 2, 2);  // nearer to its own limit
  EXPECT_EQ(worst.shown(1).t, 1);
  EXPECT_EQ(worst.shown(1).limit, 1);
  EXPECT_EQ(worst.shown(10).t, 2);
  EXPECT_EQ(worst.shown(10).limit, 0.8);
  EXPECT_TRUE(worst.shown(0.4).undecided);
  EXPECT_FALSE(worst.shown(0.4).beyond);
  worst.add(0.9, 0.8, 3, 3);
  EXPECT_TRUE(worst.shown(0.4).beyond) << "one that is beyond its own limit decides";
  EXPECT_EQ(worst.shown(0.4).t, 3);
}

TEST(Largest, isTheValueUntilMoreIsKnown) {
  EXPECT_EQ(judged("name", 2, 3, "m", "", "").largest.value, 2);
  EXPECT_EQ(notJudgeable(Reason::unfinished, "name", 2, 3, "m", "", "").largest.value, 2);
  EXPECT_TRUE(std::isnan(notMade("name", "m", "").largest.value));
  EXPECT_EQ(judged("name", 2, 3, "m", "", "").limit_by, LimitBy::derived);
  EXPECT_STREQ(name(LimitBy::derived), "derived");
  EXPECT_STREQ(name(LimitBy::user), "user");
}

TEST(Overall, isThatOfTheWorstCheck) {
  const Check pass = judged("a", 0, 1, "", "", ""), fail = notMade("b", "", "");
  const Check open = notJudgeable(Reason::not_covered, "c", 0, 0, "", "", "");
  EXPECT_EQ(overall({pass, pass}), Verdict::pass);
  EXPECT_EQ(overall({pass, open}), Verdict::inconclusive);
  EXPECT_EQ(overall({open, fail, pass}), Verdict::fail);
  EXPECT_EQ(overall({}), Verdict::fail);
}

TEST(TimeSeries, findsItsColumns) {
  TimeSeries series;
  EXPECT_EQ(series.rows(), 0u);
  series.add("t_s", {0, 1});
  series.add("tau_1_Nm", {5, 6});
  EXPECT_EQ(series.rows(), 2u);
  ASSERT_NE(series.find("tau_1_Nm"), nullptr);
  EXPECT_EQ(series.find("tau_1_Nm")->back(), 6);
  EXPECT_EQ(series.find("tau_2_Nm"), nullptr);
}

TEST(TimeSeries, refusesShortAndRepeatedColumns) {
  TimeSeries series;
  series.add("t_s", {0, 1});
  EXPECT_THROW(series.add("tau_1_Nm", {5}), std::invalid_argument);
  EXPECT_THROW(series.add("t_s", {0, 1}), std::invalid_argument);
  EXPECT_EQ(series.names.size(), 1u);
}

TEST(EffortWords, areOfTheMotors) {
  Motors motors;
  EXPECT_EQ(effortNoun(motors), "torque");
  for (Motor& motor : motors) motor.coordinate = Coordinate::d;
  EXPECT_EQ(effortNoun(motors), "force");
  motors[2].coordinate = Coordinate::phi;
  EXPECT_EQ(effortNoun(motors), "effort");
}

TEST(EffortWords, leaveNamesAlone) {
  EXPECT_EQ(inEffortWords("force", "Torques: 1 % of the largest torque, an effort's and every torque."),
            "Forces: 1 % of the largest force, a force's and every force.");
  EXPECT_EQ(inEffortWords("effort", "a torque, torques"), "an effort, efforts");
  for (const char* name : {"torque.pointwise", "--torques", "wins over [acceptance] torque", "torques.csv",
                           "own_torques", "id=\"efforts\"", "href=\"#efforts\"", "torques=tau"})
    EXPECT_EQ(inEffortWords("force", name), name);
  EXPECT_EQ(inEffortWords("torque", "a torque, an effort"), "a torque, an effort");
}

}  // namespace
}  // namespace ursula
