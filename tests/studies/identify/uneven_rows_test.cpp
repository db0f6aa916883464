// Rows that are uneven count at their own instants; even rows with wrong stamps stay even. A right model passes with
// both, and a wrong one is found.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "parts/identify/log_grid.h"
#include "parts/identify/signals.h"
#include "tests/studies/identify/paper_machine_log.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using identification::LogGrid;

/// A law by which rows are off a grid, in steps.
struct Law {
  std::string name;
  std::function<double(int row, std::mt19937& dice)> off;
};

double uniform(std::mt19937& dice, double most) { return std::uniform_real_distribution<double>(-most, most)(dice); }

const std::vector<Law>& laws() {
  static const std::vector<Law> out = {
      {"a fortieth of a step", [](int, std::mt19937& dice) { return uniform(dice, 0.025); }},
      {"a fifth of a step", [](int, std::mt19937& dice) { return uniform(dice, 0.2); }},
      {"normal", [](int, std::mt19937& dice) { return std::normal_distribution<double>(0, 0.1)(dice); }},
      {"one late row", [](int row, std::mt19937&) { return row == 1234 ? 0.7 : 0.0; }},
      {"every other row late", [](int row, std::mt19937&) { return row % 2 == 1 ? 0.1 : -0.1; }},
      {"a clock that drifts", [](int row, std::mt19937&) { return 2e-7 * row * row; }},
  };
  return out;
}

struct Rows {
  std::vector<double> exact, stamps;  ///< instants of the rows, and those that the log says
  double step = 0;
};

Rows rowsOf(const Law& law, int count, double step, unsigned seed, bool exact) {
  std::mt19937 dice(seed);
  Rows out;
  out.step = step;
  for (int i = 0; i < count; ++i) {
    const double off = i > 0 ? law.off(i, dice) : 0, even = i * step, moved = even + off * step;
    out.stamps.push_back(moved);
    out.exact.push_back(exact ? moved : even);
  }
  return out;
}

double signalAt(double t) { return std::sin(7 * t) + 0.3 * std::cos(19 * t + 1); }

MeasuredLog gridOf(const Rows& rows, double noise) {
  std::mt19937 dice(77);
  std::normal_distribution<double> normal(0, 1);
  LogGrid grid(1, {});
  for (std::size_t i = 0; i < rows.stamps.size(); ++i) {
    std::vector<double> row = {signalAt(rows.exact[i]) + noise * normal(dice)};
    grid.add(rows.stamps[i], row, [] { return std::string("a row"); });
  }
  return grid.finish("uneven.csv");
}

double errorOf(const MeasuredLog& log) {
  double out = 0;
  for (Eigen::Index i = 0; i < log.motion.rows(); ++i)
    out = std::max(out, std::abs(log.motion(i, 0) - signalAt(log.time(static_cast<double>(i)))));
  return out;
}

/// At 500 Hz neighbours at six steps leave (19 rad/s · 12 ms)⁶ / 6! = 2e-7 of the fast part.
TEST(UnevenRows, valuesAreThoseOfTheGridsInstants) {
  for (const Law& law : laws())
    for (const unsigned seed : {1U, 2U, 3U}) {
      const MeasuredLog log = gridOf(rowsOf(law, 2001, 0.002, seed, true), 0);
      EXPECT_LT(errorOf(log), 2e-7) << law.name;
      EXPECT_EQ(std::count(log.missing.begin(), log.missing.end(), true), 0) << law.name;
    }
}

/// A control: rows that are taken to be even are off by rate times displacement.
TEST(UnevenRows, areOffIfTakenToBeEven) {
  for (const Law& law : laws()) {
    Rows rows = rowsOf(law, 2001, 0.002, 1, true);
    for (std::size_t i = 0; i < rows.stamps.size(); ++i) rows.stamps[i] = static_cast<double>(i) * rows.step;
    EXPECT_GT(errorOf(gridOf(rows, 0)), 1e-4) << law.name;
  }
}

TEST(UnevenRows, keepTheirNoise) {
  for (const Law& law : laws()) {
    const MeasuredLog log = gridOf(rowsOf(law, 20001, 0.002, 4, true), 1e-3);
    double squares = 0;
    for (Eigen::Index i = 0; i < log.motion.rows(); ++i)
      squares += std::pow(log.motion(i, 0) - signalAt(log.time(static_cast<double>(i))), 2) /
                 static_cast<double>(log.motion.rows());
    EXPECT_NEAR(std::sqrt(squares), 1e-3, 3e-5) << law.name;
    EXPECT_NEAR(identification::whiteNoise(log.motion.col(0), log.filled), 1e-3, 3e-5) << law.name;
  }
}

/// The stamps' mean line is off by their deviation over the root of their number, and by twice that at its ends; with 3
/// deviations of at most 0.12 steps that is 0.02 steps of the fastest rate, 12.7 / s.
TEST(EvenRows, stayEvenUnderStampsThatAreNot) {
  for (const Law& law : laws()) {
    if (law.name == "a clock that drifts") continue;  // values cannot show which of two clocks drifts
    for (const double noise : {0.0, 1e-6})
      EXPECT_LT(errorOf(gridOf(rowsOf(law, 2001, 0.002, 5, false), noise)), 0.02 * 0.002 * 12.7 + 5 * noise)
          << law.name;
  }
}

/// Returns what the log says of its jitter, "" for nothing.
std::string saidOf(const Law& law, bool exact) {
  for (const LogFinding& each : gridOf(rowsOf(law, 2001, 0.002, 6, exact), 1e-6).findings)
    if (each.kind == "jitter") return each.what;
  return "";
}

TEST(UnevenRows, findingSaysWhatWasDone) {
  EXPECT_THAT(saidOf(laws()[1], true), HasSubstr("each row is used at its own instant"));
  EXPECT_THAT(saidOf(laws()[1], false), HasSubstr("the motion's rows are even"));
  EXPECT_EQ(saidOf(laws()[0], true), "");
}

/// The paper's machine near a singular pose, which shows rows that are off by 1e-5 of a step.
class UnevenLogs : public Identify {
 protected:
  IdentifyResult runWith(const Law& law, unsigned seed, bool exact = true) {
    auto dice = std::make_shared<std::mt19937>(seed);
    how.seed = seed;
    std::vector<double> off;
    how.off = [&](int row) {
      off.push_back(row == 0 ? 0 : law.off(row, *dice));
      return exact ? off.back() : 0.0;
    };
    SyntheticRows rows = syntheticRows(scenario, truth, how);
    for (std::size_t i = 0; i < rows.t.size() && !exact; ++i) rows.t[i] += off[i] / how.rate;
    return identify(scenario, logOf(rows, scenario), options);
  }
};

TEST_F(UnevenLogs, rightModelPassesAndAWrongMassIsFound) {
  for (const std::size_t law : {1U, 5U}) {
    const IdentifyResult result = runWith(laws()[law], 3);
    EXPECT_EQ(result.verdict, Verdict::pass) << laws()[law].name << '\n' << identifyText(result);
  }
  truth.platform.mass *= 1.05;
  const IdentifyResult wrong = runWith(laws()[1], 4);
  ASSERT_EQ(wrong.verdict, Verdict::fail);
  ASSERT_FALSE(wrong.causes.empty());
  EXPECT_EQ(wrong.causes[0].parameter, "manipulator.platform.mass") << identifyText(wrong);
}

TEST_F(UnevenLogs, evenRowsPassUnderStampsThatAreNot) {
  const IdentifyResult result = runWith(laws()[1], 5, false);
  EXPECT_EQ(result.verdict, Verdict::pass) << identifyText(result);
}

}  // namespace
}  // namespace ursula
