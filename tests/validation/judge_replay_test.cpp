// Judging made-up replays: each check fails by itself, and only a useful limit judges.

#include "validation/checks/judges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/validation/checks.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {
namespace {

const std::vector<std::string> names = {"replay.position", "replay.orientation", "closure.position", "closure.velocity",
                                        "energy.balance"};
constexpr double length = 1.4, position_scale = 2;
constexpr LoopForces forces;

/// Small errors over one window of 1 s in 11 steps.
WindowedReplay made(double growth = 1) {
  WindowedReplay out;
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k;
    out.window.t.push_back(t);
    out.window.from_acceleration.push_back(growth * 1e-9 * t);
    out.window.from_unit_rate.push_back(growth * t);
    out.window.from_start.push_back(growth);
    out.window.growth.push_back(growth * t);
    ReplayStep step;
    step.t = t;
    step.position_error.x() = step.rotation_error.y() = 1e-14 * t;
    step.closure = {1e-15, 1e-15};
    step.energy_error = 1e-12;
    out.replay.steps.push_back(step);
  }
  out.window.last = 10;
  out.replay.tolerance = 1e-14;
  out.replay.energy_scale = 1e4;
  return out;
}

std::vector<Check> judge(const std::function<void(WindowedReplay&)>& change) {
  WindowedReplay replay = made();
  change(replay);
  return judgeReplay({replay}, position_scale, length, forces);
}

TEST(JudgeReplay, acceptsSmallErrors) {
  const std::vector<Check> checks = judge([](WindowedReplay&) {});
  EXPECT_EQ(others(checks, Verdict::pass), "");
  ASSERT_EQ(checks.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(checks[k].name, names[k]);
    EXPECT_NE(checks[k].basis, "");
  }
}

TEST(JudgeReplay, catchesEachErrorByItsName) {
  const auto only = [](const std::string& name, const std::function<void(ReplayStep&)>& fault) {
    const std::vector<Check> checks = judge([&fault](WindowedReplay& replay) { fault(replay.replay.steps[4]); });
    for (const std::string& other : names)
      EXPECT_EQ(verdictOf(checks, other), other == name ? "fail" : "pass") << other;
    EXPECT_NE(findCheck(checks, name)->why.find("t = 0.4 s"), std::string::npos) << findCheck(checks, name)->why;
  };
  for (const double wrong : {1e-5, std::nan("")}) {
    only("replay.position", [wrong](ReplayStep& step) { step.position_error.z() = wrong; });
    only("replay.orientation", [wrong](ReplayStep& step) { step.rotation_error.z() = wrong; });
    only("closure.position", [wrong](ReplayStep& step) { step.closure.position = wrong; });
    only("closure.velocity", [wrong](ReplayStep& step) { step.closure.velocity = wrong; });
    only("energy.balance", [wrong](ReplayStep& step) { step.energy_error = wrong; });
    only("energy.balance", [wrong](ReplayStep& step) { step.energy_error = -wrong; });
  }
}

/// The limit is smaller early on, so an error that is allowed at the end is not allowed before.
TEST(JudgeReplay, judgesEveryStepByItsOwnLimit) {
  const double allowed_at_end = 5e-10;
  const auto faulty = [allowed_at_end](std::size_t step) {
    return verdictOf(
        judge([&](WindowedReplay& replay) { replay.replay.steps[step].position_error.x() = allowed_at_end; }),
        "replay.position");
  };
  EXPECT_EQ(faulty(10), "pass");
  EXPECT_EQ(faulty(1), "fail");
}

/// Allows the largest gaps, and the work of the loops' forces on them, for a machine of any size.
TEST(JudgeReplay, allowsTheWorkOfForcesOnTheGapsItAllows) {
  for (const auto& [size, rounding] : {std::pair(0.01, 0.0), std::pair(2.0, 1e-10), std::pair(20.0, 0.0)}) {
    WindowedReplay replay = made();
    replay.opening = {rounding / 2, rounding};
    replay.replay.energy_scale = 0;
    for (ReplayStep& step : replay.replay.steps) step.energy_error = 0;
    const auto with = [&, size = size](double force, double energy) {
      replay.replay.steps[10].energy_error = energy;
      return judgeReplay({replay}, size, length, LoopForces{force});
    };
    const double gap = findCheck(with(1e5, 0), "closure.position")->limit;
    EXPECT_NE(verdictOf(with(1e5, 0.99 * 1e5 * gap), "energy.balance"), "fail") << size;
    EXPECT_EQ(verdictOf(with(1e5, 1.01 * 1e5 * gap), "energy.balance"), "fail") << size;
    EXPECT_EQ(verdictOf(with(1e4, 0.99 * 1e5 * gap), "energy.balance"), "fail") << size;
  }
}

/// Gaps due to rounding of their accelerations are allowed in full.
TEST(JudgeReplay, allowsGapsThatOpenByTheForcesRounding) {
  const GapOpening opening{0.5e-8, 1e-8};
  const auto with = [](const GapOpening& of) {
    WindowedReplay window = made();
    window.opening = of;
    return window;
  };
  const auto limit = [](const char* check, const WindowedReplay& window) {
    return findCheck(judgeReplay({window}, position_scale, length, forces), check)->limit;
  };
  EXPECT_NEAR(limit("closure.position", with(opening)) - limit("closure.position", made()), opening.position, 1e-20);
  EXPECT_NEAR(limit("closure.velocity", with(opening)) - limit("closure.velocity", made()), opening.velocity, 1e-20);
  WindowedReplay open = with(opening);
  open.replay.steps[10].closure = {0.9 * opening.position, 0.9 * opening.velocity};
  EXPECT_EQ(others(judgeReplay({open}, position_scale, length, forces), Verdict::pass), "");
  open.opening = {opening.position / 2, opening.velocity / 2};
  const std::vector<Check> checks = judgeReplay({open}, position_scale, length, forces);
  EXPECT_EQ(verdictOf(checks, "closure.position"), "fail");
  EXPECT_EQ(verdictOf(checks, "closure.velocity"), "fail");
}

TEST(JudgeReplay, doesNotJudgeBetweenWhatIsUsefulAndALimitThatIsWider) {
  const auto judged = [](double error) {
    WindowedReplay wide = made(1e12);
    wide.replay.steps[4].position_error.x() = wide.replay.steps[4].rotation_error.y() = error;
    return judgeReplay({wide}, position_scale, length, forces);
  };
  for (const char* name : {"replay.position", "replay.orientation"}) {
    EXPECT_EQ(verdictOf(judged(1e-4), name), "inconclusive");
    EXPECT_EQ(verdictOf(judged(1e-9), name), "pass") << "a wide limit is a note";
    EXPECT_LE(findCheck(judged(1e-9), name)->limit, 1.01e-6 * length);
    EXPECT_EQ(verdictOf(judged(1e6), name), "fail");
  }
  EXPECT_EQ(verdictOf(judged(1e-4), "closure.position"), "pass");
}

TEST(JudgeReplay, failsWhereThereIsNothing) {
  EXPECT_EQ(others(judgeReplay({}, position_scale, length, forces), Verdict::fail), "");
  EXPECT_FALSE(judgeReplay({}, position_scale, length, forces).empty());
  EXPECT_EQ(others(judge([](WindowedReplay& replay) { replay.replay.steps.clear(); }), Verdict::fail), "");
}

TEST(JudgeReplay, failsWithTheReasonWhereTheIntegratorGaveUp) {
  const std::vector<Check> checks = judge([](WindowedReplay& replay) { replay.replay.gave_up = "the step vanished"; });
  EXPECT_EQ(others(checks, Verdict::fail), "");
  for (const Check& check : checks) EXPECT_NE(check.why.find("the step vanished"), std::string::npos) << check.why;
}

/// Too many evaluations prove nothing, but the completed part may already be wrong.
TEST(JudgeReplay, leavesOpenWhatTookTooLongUnlessItIsWrongAlready) {
  const auto hasty = [](double error) {
    return judge([error](WindowedReplay& window) {
      window.replay.steps.pop_back();
      window.replay.steps[4].position_error.x() = error;
      window.replay.gave_up = "more than 30 derivative evaluations";
      window.replay.too_long = true;
    });
  };
  EXPECT_EQ(others(hasty(0), Verdict::inconclusive), "");
  EXPECT_NE(hasty(0).front().why.find("more than 30"), std::string::npos) << hasty(0).front().why;
  for (double wrong : {1e-5, std::nan("")}) {
    EXPECT_EQ(verdictOf(hasty(wrong), "replay.position"), "fail");
    EXPECT_EQ(verdictOf(hasty(wrong), "closure.position"), "inconclusive");
  }
}

/// A replay of 11 steps whose errors are `factor` times t.
Replay errors(double factor, int steps = 11) {
  Replay out;
  for (int k = 0; k < steps; ++k) {
    ReplayStep step;
    step.t = 0.1 * k;
    step.position_error.x() = step.rotation_error.y() = factor * step.t;
    step.velocity_error.x() = step.spin_error.y() = factor;
    step.closure = {2 * factor * step.t, 3 * factor * step.t};
    step.energy_error = -4 * factor * step.t;
    out.steps.push_back(step);
  }
  return out;
}

TEST(IntegrationErrors, areDifferencesOfTwoReplaysAndTheGapsOfTheCoarser) {
  const IntegrationError found = integrationError(errors(1e-12), errors(1e-10));
  ASSERT_EQ(found.steps.size(), 11u);
  const IntegrationError::At at = found.at(0.5);
  EXPECT_NEAR(at.position, 99e-12 * 0.5, 1e-20);
  EXPECT_NEAR(at.rotation, 99e-12 * 0.5, 1e-20);
  EXPECT_NEAR(at.gap, 2e-10 * 0.5, 1e-20);
  EXPECT_NEAR(at.gap_rate, 3e-10 * 0.5, 1e-20);
  EXPECT_NEAR(at.energy, 4e-10 * 0.5, 1e-20);
}

/// A replay with shorter steps has smaller gaps, which show those of the longer steps by their change.
TEST(IntegrationErrors, areTheChangesOfGapsTowardsAFinerReplay) {
  Replay finer = errors(1e-12);
  finer.accepted = 20;
  const IntegrationError::At at = integrationError(errors(1e-10), finer).at(0.5);
  EXPECT_NEAR(at.gap, 198e-12 * 0.5, 1e-20);
  EXPECT_NEAR(at.gap_rate, 297e-12 * 0.5, 1e-20);
  EXPECT_NEAR(at.energy, 396e-12 * 0.5, 1e-20);
}

/// Values are the largest so far, because an error that returns to zero still occurred.
TEST(IntegrationErrors, neverFallAndKeepNaN) {
  Replay coarse = errors(0);
  coarse.steps[3].position_error.x() = 1e-9;
  const IntegrationError found = integrationError(errors(0), coarse);
  EXPECT_EQ(found.at(0.2).position, 0);
  EXPECT_EQ(found.at(0.3).position, 1e-9);
  EXPECT_EQ(found.at(1).position, 1e-9);
  coarse.steps[5].closure.position = std::nan("");
  EXPECT_TRUE(std::isnan(integrationError(errors(0), coarse).at(1).gap));
}

TEST(IntegrationErrors, areInfiniteWhereTheCoarserDidNotGetTo) {
  const IntegrationError found = integrationError(errors(1e-12), errors(1e-10, 6));
  EXPECT_TRUE(std::isfinite(found.at(0.5).position));
  EXPECT_TRUE(std::isinf(found.at(0.6).position));
  EXPECT_TRUE(std::isinf(found.at(0.6).energy));
  EXPECT_FALSE(IntegrationError{}.measured());
}

/// With a measured integration error the limit contains three times that instead of the tolerance.
TEST(JudgeReplay, takesTheMeasuredIntegrationErrorForTheTolerance) {
  WindowedReplay window = made();
  for (std::size_t k = 0; k < 10; ++k) window.replay.steps[k] = errors(0).steps[k];  // so that the end is shown
  window.integration = integrationError(errors(0), errors(1e-10));
  const WindowedReplay without = [&] {
    WindowedReplay out = window;
    out.integration = integrationError(errors(0), errors(0));
    return out;
  }();
  const auto limit = [](const WindowedReplay& of, const std::string& name) {
    return findCheck(judgeReplay({of}, position_scale, length, forces), name)->limit;
  };
  EXPECT_NEAR(replayLimit(window, position_scale, 1) - replayLimit(without, position_scale, 1), 3e-10, 1e-18);
  EXPECT_NEAR(limit(window, "replay.orientation") - limit(without, "replay.orientation"), 3e-10, 1e-18);
  EXPECT_NEAR(limit(window, "closure.position") - limit(without, "closure.position"), 6e-10, 1e-18);
  EXPECT_NEAR(limit(window, "closure.velocity") - limit(without, "closure.velocity"), 9e-10, 1e-18);
  EXPECT_NEAR(limit(window, "energy.balance") - limit(without, "energy.balance"), 12e-10, 1e-15);
  EXPECT_EQ(replayLimit(without, position_scale, 1), driftLimit(without.window, 0, 11, position_scale, 1));
  WindowedReplay coarser_tolerance = without;
  coarser_tolerance.replay.tolerance = 1e-6;
  EXPECT_EQ(replayLimit(coarser_tolerance, position_scale, 1), replayLimit(without, position_scale, 1));
  EXPECT_LT(replayLimit(without, position_scale, 1), replayLimit(made(), position_scale, 1));
}

TEST(JudgeReplay, isInconclusiveWhereTheIntegrationWasNotMeasuredToTheEnd) {
  WindowedReplay window = made();
  window.integration = integrationError(errors(0), errors(1e-13, 6));
  const std::vector<Check> checks = judgeReplay({window}, position_scale, length, forces);
  for (const char* name : {"replay.position", "replay.orientation", "closure.position"}) {
    EXPECT_EQ(verdictOf(checks, name), "inconclusive") << name;
    EXPECT_EQ(findCheck(checks, name)->reason, Reason::limit_useless) << name;
  }
}

TEST(JudgeReplay, keepsTheLargestErrorBesideTheOneNearestToItsLimit) {
  const std::vector<Check> checks = judge([](WindowedReplay& window) {
    window.replay.steps[1].position_error.x() = 1e-11;  // near its limit, early on
    window.replay.steps[10].position_error.x() = 2e-11;
  });
  const Check& check = *findCheck(checks, "replay.position");
  EXPECT_EQ(check.value, 1e-11);
  EXPECT_EQ(check.largest.value, 2e-11);
  EXPECT_DOUBLE_EQ(check.largest.t, 1);
}

}  // namespace
}  // namespace ursula
