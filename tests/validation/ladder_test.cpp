// The ladder of tolerances: the integrator's error falls with the tolerance, another integrator gets to the same place,
// and a rung that is off, no number or gave up fails.

#include "validation/ladder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/windows.h"

namespace ursula {
namespace {

using testing::HasSubstr;

/// The paper's helix climbed under a history of torques.
class Climb {
 public:
  explicit Climb(const std::function<double(double t)>& factor = [](double) { return 1.0; }) {
    const Subject solver = solverOf(scenario_);
    const SimbodyLoop::TorqueHistory torques = [&](double t) {
      return Vector6d(factor(t) * solver.torques(scenario_.trajectory->at(t)));
    };
    const std::vector<PointwiseSample> samples = rightSamples(scenario_, 11);
    position_scale_ = positionScale(samples);
    const ReplayPlan plan{torques, SampledLimit(samples), position_scale_, plannedStepRate(3)};
    const std::vector<WindowedReplay> windows = replayInWindows(scenario_, plan);
    finest_ = windows.front();
    ladder_ = climb(scenario_, torques, finest_);
  }

  const Ladder& ladder() const { return ladder_; }
  const WindowedReplay& finest() const { return finest_; }
  std::vector<Check> checks() const { return judgeLadder(ladder_, finest_, position_scale_); }
  /// What the judged replay itself may be off by, m.
  double bound() const {
    return driftLimit(finest_.window, finest_.replay.tolerance, static_cast<double>(finest_.replay.accepted),
                      position_scale_, finest_.window.end());
  }

 private:
  Scenario scenario_ = scenarioOf("paper-helix");
  WindowedReplay finest_;
  Ladder ladder_;
  double position_scale_ = 0;
};

TEST(PaperHelixLadder, converges) {
  const Climb climb;
  const Ladder& ladder = climb.ladder();
  ASSERT_EQ(ladder.rungs.size(), 3u);
  ASSERT_EQ(ladder.observed_orders.size(), 2u);
  for (double order : ladder.observed_orders) EXPECT_NEAR(order, 8, 2);
  EXPECT_TRUE(ladder.asymptotic);
  for (const Rung& rung : ladder.rungs) EXPECT_EQ(rung.gave_up, "");
  EXPECT_EQ(others(climb.checks(), Verdict::pass), "");
  for (const char* check : {"integration.ladder", "integration.second"}) {
    ASSERT_NE(findCheck(climb.checks(), check), nullptr);
    EXPECT_GT(findCheck(climb.checks(), check)->value, 0) << check;
  }
}

/// The torques being exact, the replay's distance from the path is the integrator's error, but for rounding.
TEST(PaperHelixLadder, extrapolatesTheErrorThatTheFinestReplayHas) {
  const Climb climb;
  const double error = climb.finest().replay.steps.back().position_error.norm();
  EXPECT_GT(climb.ladder().extrapolated, 0);
  EXPECT_LT(climb.ladder().extrapolated, climb.bound());
  EXPECT_LE(error, climb.ladder().extrapolated + climb.ladder().uncertainty);
  EXPECT_LT(climb.ladder().extrapolated, climb.ladder().rungs[2].distance / 10) << "nothing was extrapolated";
}

TEST(PaperHelixLadder, climbsToFinerTolerancesInMoreSteps) {
  const std::vector<Rung> rungs = Climb().ladder().rungs;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(rungs[k].integrator, Integrator::rkf78) << k;
    if (k == 0) continue;
    EXPECT_LT(rungs[k].tolerance, rungs[k - 1].tolerance);
    EXPECT_GT(rungs[k].steps, rungs[k - 1].steps);
  }
}

/// Twice, so that its own error is known; over the beginning, for it takes many more steps.
TEST(PaperHelixLadder, hasAnotherIntegratorOverTheBeginning) {
  const Climb climb;
  const Ladder& ladder = climb.ladder();
  ASSERT_EQ(ladder.second.size(), 2u);
  for (const Rung& rung : ladder.second) {
    EXPECT_STREQ(name(rung.integrator), "rk_merson");
    EXPECT_GT(rung.steps, 0);
  }
  EXPECT_DOUBLE_EQ(ladder.second[0].tolerance / ladder.second[1].tolerance, 10);
  EXPECT_LT(ladder.second[1].distance, ladder.second[0].distance);
  EXPECT_GT(ladder.second_difference, 0);
  EXPECT_GE(ladder.second_end, 0.1 * climb.finest().window.end());
  EXPECT_LT(ladder.second_end, climb.finest().window.end());
  EXPECT_LT(findCheck(climb.checks(), "integration.second")->limit, 5e-8) << "the limit says little";
}

/// The torques right but for jumps of a millionth, which no formula of eighth order steps over: steps become shorter
/// there until the end is right, but there is no order to extrapolate with.
TEST(PaperHelixLadder, convergesWithoutAnOrderWhereTheTorquesJump) {
  const Climb climb([](double t) { return 1 + (std::fmod(t, 0.2) < 0.1 ? 1e-6 : -1e-6); });
  EXPECT_FALSE(climb.ladder().asymptotic);
  EXPECT_EQ(verdictOf(climb.checks(), "integration.ladder"), "pass");
  EXPECT_THAT(findCheck(climb.checks(), "integration.ladder")->why, HasSubstr("not asymptotic"));
  EXPECT_EQ(climb.ladder().extrapolated, climb.ladder().rungs[2].distance);
}

/// Noise that is another at every instant: however fine the tolerance, the end does not settle.
TEST(PaperHelixLadder, failsWhereTheIntegrationDoesNotConverge) {
  const auto noise = [](double t) { return std::fmod(std::abs(std::sin(1e9 * t)) * 1e6, 1.0) - 0.5; };
  const Climb climb([noise](double t) { return 1 + 1e-9 * noise(t); });
  const Check* check = findCheck(climb.checks(), "integration.ladder");
  ASSERT_NE(check, nullptr);
  EXPECT_EQ(check->verdict, Verdict::fail) << check->value << " of " << check->limit << ", " << check->why;
  EXPECT_FALSE(climb.ladder().asymptotic);
}

constexpr double position_scale = 2;

/// A window of 1 s in which nothing grows.
WindowedReplay madeReplay() {
  WindowedReplay out;
  for (double t : {0.0, 0.5, 1.0}) {
    out.window.t.push_back(t);
    out.window.from_acceleration.push_back(0);
    out.window.from_unit_rate.push_back(t);
    out.window.from_start.push_back(1);
    out.window.growth.push_back(t);
    ReplayStep step;
    step.t = t;
    out.replay.steps.push_back(step);
  }
  out.replay.tolerance = 1e-14;
  return out;
}

/// Each a hundredth of the one before; the other integrator's two a tenth apart.
Ladder madeLadder() {
  Ladder out;
  out.rungs = {{Integrator::rkf78, 1e-8, 300, 20, 1e-8, ""},
               {Integrator::rkf78, 1e-10, 450, 35, 1e-10, ""},
               {Integrator::rkf78, 1e-12, 800, 62, 1e-12, ""}};
  out.second = {{Integrator::rk_merson, 1e-8, 600, 120, 2e-9, ""}, {Integrator::rk_merson, 1e-9, 900, 180, 2e-10, ""}};
  out.second_end = 0.5;
  out.second_difference = 1.8e-9;
  return out;
}

using Change = std::function<void(Ladder&)>;

std::vector<Check> judge(const Change& change) {
  Ladder ladder = madeLadder();
  change(ladder);
  return judgeLadder(ladder, madeReplay(), position_scale);
}

/// The checks after a change of one rung.
std::vector<Check> judge(std::size_t rung, const std::function<void(Rung&)>& change) {
  return judge([&](Ladder& ladder) { change(ladder.rungs[rung]); });
}

TEST(JudgeLadder, acceptsRungsWithinTheirBounds) {
  const std::vector<Check> checks = judge([](Ladder&) {});
  EXPECT_EQ(verdictOf(checks, "integration.ladder"), "pass");
  EXPECT_EQ(verdictOf(checks, "integration.second"), "pass");
}

TEST(JudgeLadder, failsARungBeyondItsBoundAndThatOneAlone) {
  const std::string names[] = {"integration.ladder", "integration.second"};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto with = [k](double distance) {
      return judge(
          [k, distance](Ladder& ladder) { (k == 0 ? ladder.rungs : ladder.second).back().distance = distance; });
    };
    const double limit = findCheck(judge([](Ladder&) {}), names[k])->limit;
    for (const double wrong : {1.01 * limit, std::nan("")}) {
      EXPECT_EQ(verdictOf(with(wrong), names[k]), "fail") << wrong;
      EXPECT_EQ(verdictOf(with(wrong), names[1 - k]), "pass") << wrong;
    }
    EXPECT_EQ(verdictOf(with(0.99 * limit), names[k]), "pass");
  }
}

/// A hundredth of the tolerance has to bring the end nearer at least four times, but for rounding.
TEST(JudgeLadder, theBoundIsAQuarterOfTheCoarserRungsDistance) {
  const auto limit = [](double coarser) {
    return findCheck(judge(1, [coarser](Rung& rung) { rung.distance = coarser; }), "integration.ladder")->limit;
  };
  EXPECT_DOUBLE_EQ(limit(1e-9), 0.25e-9);
  EXPECT_DOUBLE_EQ(limit(1e-10), 0.25e-10);
  const WindowedReplay replay = madeReplay();
  EXPECT_DOUBLE_EQ(limit(0), driftLimit(replay.window, 0, 3, position_scale, 1)) << "rounding";
  EXPECT_LT(limit(0), 1e-13);
}

/// Where knots decide the steps, a finer tolerance takes few more, and the error is asked to fall with them alone.
TEST(JudgeLadder, theBoundIsWiderWhereStepsAreHardlyMore) {
  const auto limit = [](long steps) {
    return findCheck(judge(2, [steps](Rung& rung) { rung.steps = steps; }), "integration.ladder")->limit;
  };
  EXPECT_DOUBLE_EQ(limit(35), 2e-10) << "as many steps: twice";
  EXPECT_NEAR(limit(42), 2e-10 / std::pow(1.2, 4), 1e-16);
  EXPECT_DOUBLE_EQ(limit(70), 0.25e-10) << "twice as many: a quarter";
}

/// The other integrator by what it changes itself, and by what the judged replay may be off by at that instant.
TEST(JudgeLadder, theSecondIsBoundByItsOwnErrorAndTheReplays) {
  const auto limit = [](double difference, double end) {
    return findCheck(judge([=](Ladder& ladder) { ladder.second_difference = difference, ladder.second_end = end; }),
                     "integration.second")
        ->limit;
  };
  EXPECT_NEAR(limit(2e-9, 0.5) - limit(1e-9, 0.5), 10 * 1e-9, 1e-17);
  for (const double end : {0.5, 1.0}) EXPECT_DOUBLE_EQ(limit(0, end), replayLimit(madeReplay(), position_scale, end));
  EXPECT_GT(limit(0, 1), limit(0, 0.5));
  EXPECT_EQ(verdictOf(judge([](Ladder& ladder) { ladder.second_difference = std::nan(""); }), "integration.second"),
            "fail");
}

TEST(JudgeLadder, failsWithTheReasonWhereARungGaveUp) {
  for (std::size_t rung = 0; rung < 3; ++rung) {
    const std::vector<Check> checks = judge(rung, [](Rung& it) { it.gave_up = "the step vanished"; });
    EXPECT_EQ(overall(checks), Verdict::fail) << rung;
    EXPECT_EQ(others(checks, Verdict::fail), "") << rung;
    EXPECT_THAT(checks.front().why, HasSubstr("the step vanished"));
  }
}

/// It is Simbody's own, and a stiff loop may be beyond it: that says nothing of the judged replay.
TEST(JudgeLadder, leavesTheSecondOpenWhereThatIntegratorDidNotGetThere) {
  for (std::size_t rung = 0; rung < 2; ++rung)
    for (const bool left_path : {false, true}) {
      const std::vector<Check> checks = judge([=](Ladder& ladder) {
        if (left_path)
          ladder.second[rung].left_path = true;
        else
          ladder.second[rung].gave_up = "the step vanished";
      });
      EXPECT_EQ(verdictOf(checks, "integration.ladder"), "pass");
      EXPECT_EQ(verdictOf(checks, "integration.second"), "inconclusive");
      EXPECT_EQ(findCheck(checks, "integration.second")->reason, Reason::unfinished);
    }
  EXPECT_EQ(verdictOf(judge([](Ladder& ladder) { ladder.second.clear(); }), "integration.second"), "fail");
}

TEST(JudgeLadder, failsWhereTheJudgedReplayGaveUpOrLeftThePath) {
  WindowedReplay gave_up = madeReplay(), lost = madeReplay();
  gave_up.replay.gave_up = "the step vanished";
  lost.replay.left_path = true;
  EXPECT_EQ(overall(judgeLadder(madeLadder(), gave_up, position_scale)), Verdict::fail);
  EXPECT_EQ(overall(judgeLadder(madeLadder(), lost, position_scale)), Verdict::fail);
}

TEST(JudgeLadder, isInconclusiveWhereARungLeftThePath) {
  const std::vector<Check> checks = judge(0, [](Rung& it) { it.left_path = true; });
  EXPECT_EQ(overall(checks), Verdict::inconclusive);
}

TEST(JudgeLadder, isInconclusiveWhereARungOrTheJudgedReplayTookTooLong) {
  const auto hasty = [](auto& it) { it.gave_up = "more than 30 derivative evaluations", it.too_long = true; };
  for (std::size_t rung = 0; rung < 3; ++rung) EXPECT_EQ(overall(judge(rung, hasty)), Verdict::inconclusive) << rung;
  WindowedReplay judged = madeReplay();
  hasty(judged.replay);
  EXPECT_EQ(overall(judgeLadder(madeLadder(), judged, position_scale)), Verdict::inconclusive);
}

/// One hundredth too much throws the platform off its path by more than its size.
TEST(PaperHelixLadder, saysNothingOfTorquesThatLoseTheMachine) {
  const Climb climb([](double) { return 1.01; });
  EXPECT_TRUE(climb.finest().replay.left_path);
  EXPECT_GT(climb.finest().replay.accepted, 0);
  EXPECT_EQ(overall(climb.checks()), Verdict::fail);
}

TEST(JudgeLadder, failsWhereNoneWasClimbed) {
  const std::vector<Check> checks = judgeLadder({}, madeReplay(), position_scale);
  EXPECT_EQ(verdictOf(checks, "integration.ladder"), "fail");
}

TEST(WorkPrecision, hasARowForEachRungOfTheFirstIntegrator) {
  const TimeSeries series = workPrecision(madeLadder());
  ASSERT_NE(series.find("evaluations"), nullptr);
  ASSERT_NE(series.find("rkf78_error_m"), nullptr);
  EXPECT_EQ(*series.find("evaluations"), (std::vector<double>{300, 450, 800}));
  EXPECT_EQ(*series.find("rkf78_error_m"), (std::vector<double>{1e-8, 1e-10, 1e-12}));
}

TEST(WorkPrecision, moreWorkIsMorePrecise) {
  const TimeSeries series = workPrecision(Climb().ladder());
  const std::vector<double>&work = series.columns[0], &errors = series.columns[1];
  ASSERT_EQ(work.size(), 3u);
  for (std::size_t k = 1; k < work.size(); ++k) {
    EXPECT_GT(work[k], work[k - 1]);
    EXPECT_LT(errors[k], errors[k - 1] / 10) << "a hundredth of the tolerance";
  }
}

}  // namespace
}  // namespace ursula
