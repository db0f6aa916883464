// A long motion in windows: they cover it, each is as long as its limit is useful, and each restarts on the commanded
// state.

#include "validation/replay/windows.h"
#include "tests/support/numbers.h"
#include "validation/replay/radau.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"

namespace ursula {
namespace {

/// The paper's helix in 10 s, in which deviations grow too much for one window.
struct LongHelix {
  Scenario scenario = scenarioOf("helix-10s");
  std::vector<PointwiseSample> samples = rightSamples(scenario, 21);
  Amplification amplification = linearised(scenario);
};

const LongHelix& longHelix() {
  static const LongHelix once;
  return once;
}

class LongMotion : public testing::Test {
 protected:
  SimbodyLoop::TorqueHistory right() const {
    return [this](double t) { return solver_.torques(scenario_.trajectory->at(t)); };
  }
  ReplayPlan plan() const {
    return {right(), SampledLimit(samples_), positionScale(samples_), plannedStepRate(duration_)};
  }
  /// The plan with acceleration errors multiplied by `factor`.
  ReplayPlan plan(double factor) const {
    ReplayPlan out = plan();
    out.acceleration = [this, factor](double t) { return factor * SampledLimit(samples_)(t); };
    return out;
  }
  std::vector<GrowthWindow> windows(const ReplayPlan& plan) const { return planWindows(amplification_, plan); }
  void expectCovered(const std::vector<GrowthWindow>& windows) const {
    ASSERT_FALSE(windows.empty());
    EXPECT_EQ(windows.front().start(), 0);
    EXPECT_DOUBLE_EQ(windows.back().end(), duration_);
    for (std::size_t k = 1; k < windows.size(); ++k) EXPECT_EQ(windows[k].start(), windows[k - 1].end()) << k;
  }
  /// The limit with which planWindows compares a bound, m.
  double useful() const { return useful_replay_limit / 4 * amplification_.length(); }
  std::vector<Check> judge(const std::vector<WindowedReplay>& replays) const {
    return judgeReplay(replays, positionScale(samples_), amplification_.length(), loopForces(samples_));
  }

  const Scenario& scenario_ = longHelix().scenario;
  double duration_ = scenario_.trajectory->duration();
  Subject solver_ = solverOf(scenario_);
  const std::vector<PointwiseSample>& samples_ = longHelix().samples;
  const Amplification& amplification_ = longHelix().amplification;
};

TEST_F(LongMotion, isCoveredEndToEnd) {
  const std::vector<GrowthWindow> found = windows(plan());
  EXPECT_GT(found.size(), 1u);
  expectCovered(found);
}

TEST_F(LongMotion, hasWindowsAsLongAsTheirBoundIsUseful) {
  const ReplayPlan plan = this->plan();
  const double rate = plan.step_rate * errorPerStep(scenario_.simulation.tolerance, plan.position_scale);
  std::size_t first = 0;
  for (const GrowthWindow& window : windows(plan)) {
    EXPECT_GT(plannedBound(plan, window), 0);
    EXPECT_LE(plannedBound(plan, window), useful());
    if (window.last + 1 < amplification_.instants().size()) {
      const GrowthWindow longer = amplification_.window(first, plan.acceleration, rate, 1e3);
      EXPECT_GT(longer.bound(amplification_.instants()[window.last + 1], rate, 0), useful()) << "it could be longer";
    }
    first = window.last;
  }
}

/// In so short a window both tolerances take the same steps, and the replays are the same. The measured error must be
/// that of the steps all the same.
class SingleSteps : public testing::TestWithParam<Integrator> {};

TEST_P(SingleSteps, haveTheirErrorMeasured) {
  Scenario scenario = scenarioOf("hexa");
  scenario.simulation.integrator = GetParam();
  const Subject solver = solverOf(scenario);
  const std::vector<PointwiseSample> samples = rightSamples(scenario, 21);
  const bool by_simbody = GetParam() == Integrator::rk_merson;
  ReplayPlan plan{[&](double t) { return solver.torques(scenario.trajectory->at(t)); }, SampledLimit(samples),
                  positionScale(samples), plannedStepRate(scenario.trajectory->duration())};
  plan.tolerance = by_simbody ? 1e-6 : 1e-3;
  const Amplification amplification(scenario, by_simbody ? 300 : 20);
  std::vector<WindowedReplay> windows =
      replayInWindows(scenario, plan, {amplification.window(4, plan.acceleration, 0, 0)});
  measureIntegration(scenario, plan, windows);
  const WindowedReplay& window = windows.front();
  ASSERT_EQ(window.replay.accepted, window.coarse->accepted);
  const double end = window.window.end();
  EXPECT_EQ(integrationError(window.replay, *window.coarse).at(end).position, 0)
      << "a hundredfold tolerance shows none";
  ReplayPlan sharp = plan;
  sharp.tolerance = 1e-14;
  scenario.simulation.integrator = Integrator::rkf78;
  const Replay exact = replay(scenario, sharp.torques, settingsOf(scenario, sharp, window.window, 0.01));
  const double error = (window.replay.steps.back().position_error - exact.steps.back().position_error).norm();
  std::cout << "error " << error << " m, measured " << window.integration.at(end).position << " m\n";
  EXPECT_GT(window.integration.at(end).position, 0);
  EXPECT_LE(error, integration_safety * window.integration.at(end).position + driftLimit(window.window, 0, 1, 1, end));
  if (by_simbody) {
    EXPECT_GT(error, driftLimit(window.window, 0, 1, 1, end)) << "rounding alone allows it";
    EXPECT_EQ(others(judgeReplay(windows, positionScale(samples), amplification.length(), loopForces(samples)),
                     Verdict::pass),
              "");
  }
}

INSTANTIATE_TEST_SUITE_P(Of, SingleSteps, testing::Values(Integrator::rkf78, Integrator::rk_merson),
                         [](const auto& each) { return std::string(name(each.param)); });

/// The bound of a window takes as many matrix products as half the square of its intervals. A window of a long motion
/// in which nothing grows would have all of them.
TEST(SlowMotion, hasWindowsWithBoundedWork) {
  Scenario scenario = scenarioOf("hold");
  constexpr int intervals = 40'000;
  const Amplification amplification(scenario, intervals);
  ReplayPlan plan;
  plan.acceleration = [](double) { return 0.0; };
  plan.tolerance = 0;
  double products = 0;
  std::size_t first = 0;
  for (const GrowthWindow& window : planWindows(amplification, plan)) {
    EXPECT_LE(window.last - first, amplification.longestWindow());
    products += 0.5 * std::pow(static_cast<double>(window.last - first), 2);
    first = window.last;
  }
  EXPECT_EQ(first, static_cast<std::size_t>(intervals));
  EXPECT_LT(products, 2e7);
  EXPECT_GE(Amplification(scenario, 300).longestWindow(), 300U) << "an ordinary motion may be one window";
}

TEST(SlowMotion, isLinearisedSparsely) {
  EXPECT_EQ(linearisedIntervals(1), 300);
  EXPECT_EQ(linearisedIntervals(100), 4000);
  EXPECT_EQ(linearisedIntervals(8000), 60'000);
  EXPECT_EQ(linearisedIntervals(20'000), 80'000);
  EXPECT_EQ(linearisedIntervals(1e9), 300'000);
}

TEST_F(LongMotion, isPlannedUntilTheDeadline) {
  ReplayPlan plan = this->plan();
  int asked = 0;
  plan.deadline = Deadline(0, [&asked] { return ++asked > 10; });
  EXPECT_THROW(windows(plan), OutOfTime) << "it looks within a window";
  EXPECT_EQ(asked, 11);
}

TEST_F(LongMotion, needsMoreWindowsForLargerErrors) {
  std::size_t before = windows(plan()).size();
  for (double factor : {1e2, 1e4, 1e6}) {
    const std::vector<GrowthWindow> found = windows(plan(factor));
    EXPECT_GT(found.size(), before) << factor;
    expectCovered(found);
    before = found.size();
  }
}

TEST_F(LongMotion, hasTheShortestWindowsWhereNoneIsUseful) {
  const ReplayPlan hopeless = plan(1e12);
  const std::vector<GrowthWindow> found = windows(hopeless);
  EXPECT_EQ(found.size(), amplification_.instants().size() - 1);
  expectCovered(found);
  for (const GrowthWindow& window : found) EXPECT_GT(plannedBound(hopeless, window), useful());
}

TEST_F(LongMotion, restartsOnTheCommandedState) {
  const std::vector<WindowedReplay> replays = replayInWindows(scenario_, amplification_, plan());
  double before = 1;  // the first window has no predecessor
  for (const WindowedReplay& each : replays) {
    ASSERT_EQ(each.replay.gave_up, "");
    const ReplayStep& step = each.replay.steps.front();
    EXPECT_EQ(step.t, each.window.start());
    EXPECT_DOUBLE_EQ(each.replay.steps.back().t, each.window.end());
    EXPECT_LE(step.position_error.norm(), 8 * eps * positionScale(samples_));
    EXPECT_LE(step.rotation_error.norm(), 8 * eps);
    EXPECT_LE(step.velocity_error.norm() + step.spin_error.norm(), 8 * eps);  // of less than 1 m/s and 1 rad/s
    EXPECT_GT(before, 100 * eps) << "there was nothing to leave behind";
    before = each.replay.steps.back().position_error.norm();
  }
  EXPECT_EQ(others(judge(replays), Verdict::pass), "");
}

/// One window would not suffice.
TEST_F(LongMotion, couldNotBeJudgedInOne) {
  const ReplayPlan plan = this->plan();
  const double rate = plan.step_rate * errorPerStep(scenario_.simulation.tolerance, plan.position_scale);
  const GrowthWindow whole = amplification_.window(0, plan.acceleration, rate, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(whole.end(), duration_);
  const std::vector<Check> checks = judge(replayInWindows(scenario_, plan, {whole}));
  EXPECT_EQ(verdictOf(checks, "replay.position"), "inconclusive");
  EXPECT_EQ(verdictOf(checks, "replay.orientation"), "inconclusive");
}

TEST_F(LongMotion, keepsAnErrorInItsWindow) {
  const std::vector<GrowthWindow> planned = windows(plan());
  ASSERT_GE(planned.size(), 3u);
  const double from = planned[1].start(), to = planned[1].end();
  ReplayPlan wrong = plan();
  wrong.torques = [&, right = right()](double t) { return Vector6d((t >= from && t < to ? 1 + 1e-8 : 1) * right(t)); };
  const std::vector<WindowedReplay> replays = replayInWindows(scenario_, wrong, planned);
  for (std::size_t k = 0; k < replays.size(); ++k)
    EXPECT_EQ(verdictOf(judge({replays[k]}), "replay.position"), k == 1 ? "fail" : "pass") << "window " << k;
  EXPECT_EQ(verdictOf(judge(replays), "replay.position"), "fail");
}

TEST_F(LongMotion, givesUpWhereAWindowTakesTooMuch) {
  ReplayPlan hasty = plan();
  hasty.max_evaluations = 30;
  for (const WindowedReplay& each : replayInWindows(scenario_, amplification_, hasty))
    EXPECT_THAT(each.replay.gave_up, testing::HasSubstr("more than 30 derivative evaluations"));
}

/// A plan with far too few steps makes windows too long; the number of steps taken corrects them.
TEST_F(LongMotion, isPlannedAgainWhereMoreStepsWereTaken) {
  ReplayPlan rash = plan();
  rash.tolerance = 1e-12;  // so that steps, not torques, limit the windows
  rash.step_rate /= 100;
  const std::vector<GrowthWindow> first = windows(rash);
  const std::vector<Check> of_first = judge(replayInWindows(scenario_, rash, first));
  EXPECT_THAT(findCheck(of_first, "replay.position")->why, testing::HasSubstr("note: the derived limit"));
  const std::vector<WindowedReplay> again = replayInWindows(scenario_, amplification_, rash);
  EXPECT_GT(again.size(), first.size());
  const std::vector<Check> of_again = judge(again);
  EXPECT_EQ(verdictOf(of_again, "replay.position"), "pass");
  EXPECT_THAT(findCheck(of_again, "replay.position")->why, testing::Not(testing::HasSubstr("note")));
}

TEST_F(LongMotion, isLinearisedAtFortyIntervalsASecond) {
  EXPECT_EQ(amplification_.instants().size(), 401u);
  EXPECT_EQ(linearised(scenarioOf("paper-helix")).instants().size(), 301u) << "300 at least";
}

TEST(SampledLimit, isTheLargerOfTwoNeighbours) {
  std::vector<PointwiseSample> samples(3);
  for (std::size_t k = 0; k < 3; ++k) {
    samples[k].motion.t = static_cast<double>(k);
    samples[k].conditioning.kappa_B = samples[k].conditioning.kappa_legs = 1;
    samples[k].conditioning.torque_scale = 1;
    samples[k].conditioning.response = k == 1 ? 5.0 : 2.0 - static_cast<double>(k) / 2;  // 2, 5, 1
  }
  const SampledLimit limit(samples);
  const double unit = samples[2].conditioning.accelerationRounding();
  ASSERT_GT(unit, 0);
  EXPECT_DOUBLE_EQ(limit(0) / unit, 2);
  EXPECT_DOUBLE_EQ(limit(0.3) / unit, 5);
  EXPECT_DOUBLE_EQ(limit(1.7) / unit, 5);
  EXPECT_DOUBLE_EQ(limit(7) / unit, 5) << "beyond the end, the last two";
  samples[1].conditioning.response = 0.5;
  EXPECT_DOUBLE_EQ(limit(1.7) / unit, 1);
}

/// Legs of a gram under half a ton do not matter, because their coordinates are eliminated. Steps that are so long that
/// the noise of one derivative exceeds the tolerance do.
TEST(ReachableTolerance, isTheScenariosUnlessDerivativesAreNoisier) {
  const Scenario helix = scenarioOf("paper-helix"), light_legs = scenarioOf("light-legs");
  const double rate = plannedStepRate(3);
  EXPECT_EQ(reachableTolerance(helix, rate), helix.simulation.tolerance);
  EXPECT_EQ(reachableTolerance(light_legs, rate), light_legs.simulation.tolerance);
  const double noisy = reachableTolerance(light_legs, 1e-6 * rate);
  EXPECT_GT(noisy, 100 * light_legs.simulation.tolerance);
  EXPECT_NEAR(reachableTolerance(light_legs, 1e-7 * rate) / noisy, 10, 1e-9) << "in proportion to the step";
  EXPECT_NEAR(reachableTolerance(light_legs, 1e-6 * rate, true) / noisy, RadauStep::noiseInError() / 0.1, 1e-9);
  EXPECT_GT(RadauStep::noiseInError(), 1);
}

}  // namespace
}  // namespace ursula
