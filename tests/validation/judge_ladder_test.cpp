// Judging made-up ladders: each rung has its own bound.

#include "validation/replay/ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "validation/checks/judges.h"
#include "validation/findings/findings.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {
namespace {

constexpr double position_scale = 2;

/// A window of 1 s in which nothing grows. For a machine of length 0 no distance is harmless.
WindowedReplay madeReplay(double length = 0) {
  WindowedReplay out;
  out.window.length = length;
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

/// Each distance is a hundredth of the previous one; those of the other integrator differ by a factor of ten.
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

std::vector<Check> judge(const Change& change, double length = 0) {
  Ladder ladder = madeLadder();
  change(ladder);
  return judgeLadder(ladder, madeReplay(length), position_scale);
}

/// The checks after a change of one rung.
std::vector<Check> judge(std::size_t rung, const std::function<void(Rung&)>& change) {
  return judge([&](Ladder& ladder) { change(ladder.rungs[rung]); });
}

TEST(JudgeLadder, acceptsRungsWithinTheirBounds) {
  const std::vector<Check> checks = judge([](Ladder&) {}, 1);
  EXPECT_EQ(verdictOf(checks, "integration.ladder"), "pass");
  EXPECT_EQ(verdictOf(checks, "integration.second"), "pass");
}

TEST(JudgeLadder, failsARungBeyondItsBoundAndThatOneAlone) {
  const std::string names[] = {"integration.ladder", "integration.second"};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto with = [k](double distance) {
      return judge(
          [k, distance](Ladder& ladder) { (k == 0 ? ladder.rungs : ladder.second).back().distance = distance; }, 1);
    };
    const double limit = findCheck(judge([](Ladder&) {}, 1), names[k])->limit;
    for (const double wrong : {1.01 * limit, std::nan("")}) {
      EXPECT_EQ(verdictOf(with(wrong), names[k]), "fail") << wrong;
      EXPECT_EQ(verdictOf(with(wrong), names[1 - k]), "pass") << wrong;
    }
    EXPECT_EQ(verdictOf(with(0.99 * limit), names[k]), "pass");
  }
}

/// A hundredth of the tolerance must bring the end at least four times nearer, except for rounding.
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

/// If knots set the steps, a finer tolerance takes few more steps, and the error need only fall with these.
TEST(JudgeLadder, theBoundIsWiderWhereStepsAreHardlyMore) {
  const auto limit = [](long steps) {
    return findCheck(judge(2, [steps](Rung& rung) { rung.steps = steps; }), "integration.ladder")->limit;
  };
  EXPECT_DOUBLE_EQ(limit(35), 2e-10) << "as many steps: twice";
  EXPECT_NEAR(limit(42), 2e-10 / std::pow(1.2, 4), 1e-16);
  EXPECT_DOUBLE_EQ(limit(70), 0.25e-10) << "twice as many: a quarter";
}

/// Two rungs that are the same run are no evidence, be the distance large; nor is a rung alone.
TEST(JudgeLadder, saysNothingWhereRungsAreTheSameRun) {
  const auto same = [](long finest_steps) {
    WindowedReplay finest = madeReplay(1);
    finest.replay.accepted = finest_steps;
    Ladder ladder = madeLadder();
    ladder.rungs[1].distance = ladder.rungs[2].distance = 1e-6;
    ladder.rungs[1].steps = ladder.rungs[2].steps;
    return judgeLadder(ladder, finest, position_scale);
  };
  EXPECT_EQ(verdictOf(same(70), "integration.ladder"), "inconclusive");
  EXPECT_THAT(findCheck(same(70), "integration.ladder")->why, HasSubstr("the same steps"));
  EXPECT_EQ(verdictOf(same(200), "integration.ladder"), "fail") << "the tolerance is ignored";
  const std::vector<Check> alone = judge([](Ladder& ladder) { ladder.rungs.resize(1); }, 1);
  EXPECT_EQ(verdictOf(alone, "integration.ladder"), "inconclusive");
  EXPECT_THAT(findCheck(alone, "integration.ladder")->why, HasSubstr("two are needed"));
  EXPECT_EQ(verdictOf(alone, "integration.second"), "pass");
}

/// The other integrator's bound is its own change plus the possible error of the judged replay at that instant.
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

/// Simbody's own integrator may fail on a stiff loop, which says nothing about the judged replay.
TEST(JudgeLadder, leavesTheSecondOpenWhereThatIntegratorDidNotGetThere) {
  for (std::size_t rung = 0; rung < 2; ++rung)
    for (const bool left_path : {false, true}) {
      const std::vector<Check> checks = judge(
          [=](Ladder& ladder) {
            if (left_path)
              ladder.second[rung].left_path = true;
            else
              ladder.second[rung].gave_up = "the step vanished";
          },
          1);
      EXPECT_EQ(verdictOf(checks, "integration.ladder"), "pass");
      EXPECT_EQ(verdictOf(checks, "integration.second"), "inconclusive");
      EXPECT_EQ(findCheck(checks, "integration.second")->reason, Reason::unfinished);
    }
  EXPECT_EQ(verdictOf(judge([](Ladder& ladder) { ladder.second.clear(); }), "integration.second"), "fail");
}

/// Accelerations that violate Simbody's own constraints are no evidence.
TEST(JudgeLadder, asksNoIntegratorThatContradictsItself) {
  const auto second = [](double contradiction) {
    return *findCheck(judge([=](Ladder& ladder) { ladder.second_contradiction = contradiction; }, 1),
                      "integration.second");
  };
  EXPECT_EQ(second(1e-12).verdict, Verdict::pass);
  for (const double contradiction : {1e-3, std::nan("")}) {
    EXPECT_EQ(second(contradiction).verdict, Verdict::not_applicable) << contradiction;
    EXPECT_THAT(second(contradiction).why, HasSubstr("nearly massless"));
  }
}

/// If ten times the accuracy takes a fourth-order method ten times the steps, it follows noise. Its disagreement is
/// then no evidence, but its agreement is.
TEST(JudgeLadder, asksNoIntegratorWhoseStepsFollowNoise) {
  const auto second = [](long evaluations, double distance) {
    return *findCheck(judge(
                          [=](Ladder& ladder) {
                            ladder.second.back().evaluations = evaluations;
                            ladder.second.back().distance = distance;
                          },
                          1),
                      "integration.second");
  };
  EXPECT_EQ(second(1000, 1e-3).verdict, Verdict::fail);
  EXPECT_EQ(second(6000, 1e-3).verdict, Verdict::not_applicable);
  EXPECT_THAT(second(6000, 1e-3).why, HasSubstr("6000 evaluations"));
  EXPECT_EQ(second(6000, 2e-10).verdict, Verdict::pass);
}

TEST(JudgeLadder, failsWhereTheJudgedReplayGaveUpOrLeftThePath) {
  WindowedReplay gave_up = madeReplay(), lost = madeReplay();
  gave_up.replay.gave_up = "the step vanished";
  lost.replay.left_path = true;
  for (const WindowedReplay* judged : {&gave_up, &lost}) {
    const std::vector<Check> checks = judgeLadder(madeLadder(), *judged, position_scale);
    EXPECT_EQ(overall(checks), Verdict::fail);
    EXPECT_EQ(verdictOf(checks, "integration.second"), "not_applicable");
    EXPECT_THAT(findCheck(checks, "integration.second")->why, HasSubstr("the judged replay"));
  }
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

TEST(JudgeLadder, failsWhereNoneWasClimbed) {
  const std::vector<Check> checks = judgeLadder({}, madeReplay(), position_scale);
  EXPECT_EQ(verdictOf(checks, "integration.ladder"), "fail");
}

TEST(WorkPrecision, hasARowForEachRungOfTheFirstIntegrator) {
  const Curve curve = workPrecision(madeLadder());
  EXPECT_EQ(curve.x, (std::vector<double>{300, 450, 800}));
  ASSERT_EQ(curve.lines.size(), 1u);
  EXPECT_EQ(curve.lines[0].values, (std::vector<double>{1e-8, 1e-10, 1e-12}));
}

}  // namespace
}  // namespace ursula
