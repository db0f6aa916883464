// The ladder of tolerances: the integrator's error falls with the tolerance, another integrator ends at the same place,
// and a rung that is wrong, NaN or gave up fails.

#include "validation/replay/ladder.h"
#include "parts/fast/fast_subject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/matchers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/findings/findings.h"
#include "validation/replay/windows.h"

namespace ursula {
namespace {

/// The paper's helix climbed under a history of torques.
class Climb {
 public:
  explicit Climb(const std::function<double(double t)>& factor = [](double) { return 1.0; }) {
    const Subject solver = fastSubject(*scenario_.manipulator, scenario_.load);
    const SimbodyLoop::TorqueHistory torques = [&](double t) {
      return Vector6d(factor(t) * solver.torques(scenario_.trajectory->at(t)));
    };
    const std::vector<PointwiseSample> samples = rightSamples(scenario_, 11);
    position_scale_ = positionScale(samples);
    const ReplayPlan plan{torques, SampledLimit(samples), position_scale_, plannedStepRate(3)};
    const std::vector<WindowedReplay> windows = replayInWindows(scenario_, linearised(scenario_), plan);
    finest_ = windows.front();
    ladder_ = replayLadder(scenario_, torques, finest_);
  }

  const Ladder& ladder() const { return ladder_; }
  const WindowedReplay& finest() const { return finest_; }
  std::vector<Check> checks() const { return judgeLadder(ladder_, finest_, position_scale_); }
  /// The possible error of the judged replay, m.
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

const Climb& rightClimb() {
  static const Climb once;
  return once;
}

TEST(PaperHelixLadder, converges) {
  const Ladder& ladder = rightClimb().ladder();
  ASSERT_EQ(ladder.rungs.size(), 3u);
  ASSERT_EQ(ladder.observed_orders.size(), 2u);
  for (double order : ladder.observed_orders) EXPECT_NEAR(order, 8, 2);
  EXPECT_TRUE(ladder.asymptotic);
  for (const Rung& rung : ladder.rungs) EXPECT_EQ(rung.gave_up, "");
  const std::vector<Check> checks = rightClimb().checks();
  EXPECT_EQ(others(checks, Verdict::pass), "");
  for (const char* check : {"integration.ladder", "integration.second"}) {
    ASSERT_NE(findCheck(checks, check), nullptr);
    EXPECT_GT(findCheck(checks, check)->value, 0) << check;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(ladder.rungs[k].integrator, Integrator::rkf78) << k;
    if (k == 0) continue;
    EXPECT_LT(ladder.rungs[k].tolerance, ladder.rungs[k - 1].tolerance);
    EXPECT_GT(ladder.rungs[k].steps, ladder.rungs[k - 1].steps) << "finer tolerances take more";
  }
}

/// It runs twice, so that its own error is known, and only over the beginning, because it takes many more steps.
TEST(PaperHelixLadder, hasAnotherIntegratorOverTheBeginning) {
  const Climb& replayLadder = rightClimb();
  const Ladder& ladder = replayLadder.ladder();
  ASSERT_EQ(ladder.second.size(), 2u);
  for (const Rung& rung : ladder.second) {
    EXPECT_STREQ(name(rung.integrator), "rk_merson");
    EXPECT_GT(rung.steps, 0);
  }
  EXPECT_DOUBLE_EQ(ladder.second[0].tolerance / ladder.second[1].tolerance, 10);
  EXPECT_LT(ladder.second[1].distance, ladder.second[0].distance);
  EXPECT_GT(ladder.second_difference, 0);
  EXPECT_GE(ladder.second_end, 0.1 * replayLadder.finest().window.end());
  EXPECT_LT(ladder.second_end, replayLadder.finest().window.end());
  EXPECT_LT(findCheck(replayLadder.checks(), "integration.second")->limit, 5e-8) << "the limit says little";
}

/// The torques are right except for jumps of a millionth, at which a formula of eighth order loses its order.
/// Whether Fehlberg's error estimate sees a jump depends on its place in a step. So the end
/// converges for some places of the jumps and not for others.
TEST(PaperHelixLadder, hasNoOrderWhereTheTorquesJump) {
  int settled = 0;
  for (const double later : {0.0, 0.007, 0.021, 0.035, 0.056}) {
    const Climb replayLadder([later](double t) { return 1 + (std::fmod(t + later, 0.2) < 0.1 ? 1e-6 : -1e-6); });
    EXPECT_FALSE(replayLadder.ladder().asymptotic) << later;
    EXPECT_THAT(findCheck(replayLadder.checks(), "integration.ladder")->why, HasSubstr("not asymptotic")) << later;
    if (verdictOf(replayLadder.checks(), "integration.ladder") != "fail") ++settled;
  }
  EXPECT_GT(settled, 0);
}

/// Noise differs at every instant, so the end does not converge however fine the tolerance is.
TEST(PaperHelixLadder, failsWhereTheIntegrationDoesNotConverge) {
  const auto noise = [](double t) { return std::fmod(std::abs(std::sin(1e9 * t)) * 1e6, 1.0) - 0.5; };
  const Climb replayLadder([noise](double t) { return 1 + 1e-9 * noise(t); });
  const std::vector<Check> checks = replayLadder.checks();
  const Check* check = findCheck(checks, "integration.ladder");
  ASSERT_NE(check, nullptr);
  EXPECT_EQ(check->verdict, Verdict::fail) << check->value << " of " << check->limit << ", " << check->why;
  EXPECT_FALSE(replayLadder.ladder().asymptotic);
}

/// Torques one hundredth too large move the platform off its path by more than its size.
TEST(PaperHelixLadder, saysNothingOfTorquesThatLoseTheMachine) {
  const Climb replayLadder([](double) { return 1.01; });
  EXPECT_TRUE(replayLadder.finest().replay.left_path);
  EXPECT_GT(replayLadder.finest().replay.accepted, 0);
  EXPECT_EQ(overall(replayLadder.checks()), Verdict::fail);
}

TEST(WorkPrecision, moreWorkIsMorePrecise) {
  const Curve curve = workPrecision(rightClimb().ladder());
  const std::vector<double>&work = curve.x, &errors = curve.lines.at(0).values;
  ASSERT_EQ(work.size(), 3u);
  for (std::size_t k = 1; k < work.size(); ++k) {
    EXPECT_GT(work[k], work[k - 1]);
    EXPECT_LT(errors[k], errors[k - 1] / 10) << "a hundredth of the tolerance";
  }
}

}  // namespace
}  // namespace ursula
