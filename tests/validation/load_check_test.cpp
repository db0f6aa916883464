// The load over time: LoadHistory keeps its promises, and tables and curves that break them fail.

#include "validation/checks/judges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/validation/checks.h"
#include "validation/limits/conditioning.h"

namespace ursula {
namespace {

/// A table with uneven times, extrema, flat parts, and values over many orders of magnitude.
std::vector<TimedWrench> table() {
  std::mt19937_64 engine(7);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  std::vector<TimedWrench> rows;
  double t = -0.3;
  for (int i = 0; i < 100; ++i) {
    TimedWrench row;
    row.time = t += 1e-3 + std::abs(uniform());
    row.wrench.force = {1e3 * uniform(), 1 + uniform() * 1e-9, i % 3 == 0 ? 0 : 5 * uniform()};
    row.wrench.moment = {std::exp(30 * uniform()), 40, i * uniform()};
    rows.push_back(row);
  }
  return rows;
}

TEST(LoadCheck, passesWithAMarginWhatLoadHistoryMakesOfATable) {
  const LoadHistory history(table());
  const Check check = judgeLoadTable(table(), [&](double t) { return history.at(t); });
  EXPECT_EQ(check.verdict, Verdict::pass) << check.why;
  EXPECT_GT(check.value, 0) << "something is rounded";
  EXPECT_LE(check.value, check.limit / 3);
}

TEST(LoadCheck, seesARowThatIsNotTheTables) {
  const LoadHistory history(table());
  for (const std::size_t i : {0u, 31u, 99u}) {
    std::vector<TimedWrench> wrong = table();
    wrong[i].wrench.force.x() *= 1 + 1e-15;
    EXPECT_EQ(judgeLoadTable(wrong, [&](double t) { return history.at(t); }).verdict, Verdict::fail) << i;
  }
}

/// Beside a row that is off by little, which is beyond its limit of 0, the largest error lies between the rows.
TEST(LoadCheck, keepsTheLargestErrorBesideTheLargestShare) {
  const LoadHistory history(table());
  const double row = table()[31].time;
  const auto wrong = [&](double t) {
    Wrench<double> wrench = history.at(t);
    if (t == row) wrench.force.x() *= 1 + 1e-14;
    if (t > table()[39].time && t < table()[40].time) wrench.moment.y() += 0.5;
    return wrench;
  };
  const Check check = judgeLoadTable(table(), wrong);
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_NEAR(check.largest.value, 0.5, 1e-9);
  EXPECT_GT(check.largest.t, table()[39].time);
  EXPECT_EQ(check.largest.where, "m_y");
  EXPECT_LT(check.value, 0.1) << "the largest share is the row's: nothing is shown";
}

class WrongCurve : public testing::TestWithParam<const char*> {};

/// The load is wrong between two rows and right at the rows.
Wrench<double> wrongBetween(const std::string& way, const LoadHistory& history, double t) {
  const std::vector<double>& knots = history.knots();
  Wrench<double> wrench = history.at(t);
  const auto after = std::upper_bound(knots.begin(), knots.end(), t);
  if (way == "not constant beyond" && after == knots.end() && t > knots.back()) wrench.moment.z() += 1e-9;
  if (after == knots.begin() || after == knots.end() || t == *(after - 1)) return wrench;
  const double s = (t - *(after - 1)) / (*after - *(after - 1));
  const Wrench<double> from = history.at(*(after - 1)), to = history.at(*after);
  if (way == "straight lines") wrench.force = from.force + s * (to.force - from.force);
  if (way == "off by 1e-9") wrench.force *= 1 + 1e-9;
  if (way == "out of range") wrench.force.y() = std::max(from.force.y(), to.force.y()) + 1e-9;
  if (way == "no number") wrench.moment.x() = std::nan("");
  return wrench;
}

TEST_P(WrongCurve, fails) {
  const LoadHistory history(table());
  const Check check = judgeLoadTable(table(), [&](double t) { return wrongBetween(GetParam(), history, t); });
  EXPECT_EQ(check.verdict, Verdict::fail) << check.why;
}

INSTANTIATE_TEST_SUITE_P(Ways, WrongCurve,
                         testing::Values("straight lines", "off by 1e-9", "out of range", "no number",
                                         "not constant beyond"));

TEST(LoadCheck, holdsAConstantLoadAgainstItself) {
  Load load;
  load.force = {1, 2, 3};
  load.moment = {4, 5, 6};
  EXPECT_EQ(judgeLoad(load, 3).verdict, Verdict::pass);
  load.moment.z() = std::nan("");
  EXPECT_EQ(judgeLoad(load, 3).verdict, Verdict::fail);
}

/// A mapped history goes through its rows, but not like their table, because slopes are limited by component.
TEST(LoadCheck, seesSlopesThatAreNotOfTheRows) {
  Load load;
  Matrix6d map = Matrix6d::Identity();
  load.history = std::make_shared<const LoadHistory>(LoadHistory(table()), map, 1);
  EXPECT_EQ(judgeLoad(load, 3).verdict, Verdict::pass);
  map(0, 2) = 1;
  load.history = std::make_shared<const LoadHistory>(LoadHistory(table()), map, 1);
  EXPECT_EQ(judgeLoad(load, 3).verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula
