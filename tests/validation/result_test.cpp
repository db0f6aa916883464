#include "validation/result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace ursula {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
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

TEST(NotJudgeable, isInconclusiveEvenWithinItsLimit) {
  EXPECT_EQ(notJudgeable("name", 0, 1, "m", "basis", "why").verdict, Verdict::inconclusive);
}

TEST(Overall, isThatOfTheWorstCheck) {
  const Check pass = judged("a", 0, 1, "", "", ""), fail = notMade("b", "", "");
  const Check open = notJudgeable("c", 0, 0, "", "", "");
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

}  // namespace
}  // namespace ursula
