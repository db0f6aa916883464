// Which error moved the replay: the largest share is named, and a limit that prevents judging comes before all.

#include "validation/attribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/windows.h"

namespace ursula {
namespace {

/// A window that carries its acceleration limit to `from_limit` m and a deviation at its start to `growth` times that.
WindowedReplay made(double growth, double from_limit, double gap, double observed) {
  WindowedReplay out;
  out.window.t = {0, 1};
  out.window.from_acceleration = {0, from_limit};
  out.window.from_unit_rate = {0, 1};
  out.window.from_start = {1, growth};
  out.window.growth = {0, growth};
  out.replay.steps.resize(2);
  out.replay.steps[0].closure.position = gap;
  out.replay.steps[1].position_error.x() = observed;
  return out;
}

/// One sample whose torque is off by that share of its limit.
std::vector<PointwiseSample> samplesWith(double share) {
  PointwiseSample sample;
  sample.torque.error = share * 1e-8;
  sample.torque.limit = 1e-8;
  return {sample};
}

Ladder ladderWith(double extrapolated) {
  Ladder ladder;
  ladder.extrapolated = extrapolated;
  return ladder;
}

Check inconclusive(const std::string& name) { return notJudgeable(name, 1, 2, "m", "basis", "why"); }

const std::vector<WindowedReplay> one_window = {made(1000, 1e-8, 1e-15, 3e-12)};

TEST(Attribution, measuresEachShare) {
  const ErrorBudget budget = attribute(samplesWith(0.25), one_window, ladderWith(4e-11), {});
  EXPECT_DOUBLE_EQ(budget.model, 0.25e-8);
  EXPECT_DOUBLE_EQ(budget.integration, 4e-11);
  EXPECT_DOUBLE_EQ(budget.closure, 1e-12);
  EXPECT_DOUBLE_EQ(budget.observed, 3e-12);
  EXPECT_DOUBLE_EQ(budget.amplification, 1000);
}

TEST(Attribution, namesTheLargestShare) {
  EXPECT_EQ(attribute(samplesWith(0.1), one_window, ladderWith(5e-10), {}).dominant, "model");
  EXPECT_EQ(attribute(samplesWith(0.01), one_window, ladderWith(5e-10), {}).dominant, "integration");
  EXPECT_EQ(attribute(samplesWith(0.01), {made(1000, 1e-8, 1e-12, 0)}, ladderWith(5e-10), {}).dominant, "closure");
}

TEST(Attribution, takesTheSampleThatUsesMostOfItsLimit) {
  std::vector<PointwiseSample> samples = samplesWith(0.1);
  samples.push_back(samplesWith(0.3).front());
  samples.push_back(samples.front());
  samples.back().torque = {2e-9, 1e-7, 0};  // larger in N·m than the first, and a smaller share
  EXPECT_DOUBLE_EQ(attribute(samples, one_window, ladderWith(0), {}).model, 0.3e-8);
}

TEST(Attribution, looksAtTheWindowWhereDeviationsGrowMost) {
  const std::vector<WindowedReplay> windows = {made(10, 1e-6, 1e-9, 7e-12), made(1000, 1e-8, 1e-15, 3e-12),
                                               made(100, 1e-7, 1e-9, 5e-12)};
  const ErrorBudget budget = attribute(samplesWith(1), windows, ladderWith(0), {});
  EXPECT_EQ(budget.amplification, 1000);
  EXPECT_DOUBLE_EQ(budget.model, 1e-8);
  EXPECT_DOUBLE_EQ(budget.closure, 1e-12);
  EXPECT_DOUBLE_EQ(budget.observed, 7e-12) << "what was observed is over all of them";
}

TEST(Attribution, amplificationDominatesWhereItPreventsJudging) {
  const auto dominant = [](const std::vector<Check>& checks) {
    return attribute(samplesWith(0.1), one_window, ladderWith(0), checks).dominant;
  };
  EXPECT_EQ(dominant({inconclusive("replay.position")}), "amplification");
  EXPECT_EQ(dominant({inconclusive("replay.orientation")}), "amplification");
  EXPECT_EQ(dominant({inconclusive("feedback.torque")}), "model") << "that one's limit is no amplification";
  EXPECT_EQ(dominant({notMade("replay.position", "m", "gave up")}), "model") << "a failure prevents nothing";
}

TEST(Attribution, withoutAReplayTheModelIsToBlameUnlessALimitPreventedIt) {
  const auto dominant = [](const std::vector<Check>& checks) {
    return attribute(samplesWith(1), {}, ladderWith(1), checks).dominant;
  };
  EXPECT_EQ(dominant({}), "model");
  EXPECT_EQ(dominant({notMade("replay.position", "m", "there was no replay")}), "model");
  EXPECT_EQ(dominant({inconclusive("replay.position")}), "amplification");
  EXPECT_EQ(dominant({inconclusive("replay.position"), notMade("torque.pointwise", "N m", "no answer")}), "model");
}

TEST(Attribution, becomesFindings) {
  ValidationResult result;
  addBudget(attribute(samplesWith(0.01), one_window, ladderWith(5e-10), {}), result);
  EXPECT_THAT(result.findings, testing::Contains(testing::Pair("dominant error", "integration")));
  EXPECT_THAT(result.findings,
              testing::Contains(testing::Pair("integration's share, extrapolated", testing::HasSubstr("5e-10"))));
}

/// The whole of it for torques by a factor: a torque error of a billionth is beyond anything that the integrator does.
TEST(Attribution, findsTorquesThatAreOffByABillionth) {
  const Scenario scenario = scenarioOf("paper-helix");
  const Subject solver = solverOf(scenario);
  const auto budgetOf = [&](double factor) {
    Subject subject = solver;
    subject.torques = [&, factor](const Motion<double>& motion) { return Vector6d(factor * solver.torques(motion)); };
    const auto samples = runPointwise(scenario, subject, equallySpaced(3, 7));
    const SimbodyLoop::TorqueHistory torques = [&](double t) { return subject.torques(scenario.trajectory->at(t)); };
    const ReplayPlan plan{torques, SampledLimit(samples), positionScale(samples), plannedStepRate(3)};
    return attribute(samples, replayInWindows(scenario, plan), ladderWith(4.5e-11), {});
  };
  const ErrorBudget right = budgetOf(1), wrong = budgetOf(1 + 1e-9);
  EXPECT_NE(right.dominant, "model");
  EXPECT_EQ(wrong.dominant, "model");
  EXPECT_GT(wrong.model, 100 * right.model);
  EXPECT_GE(wrong.model, wrong.observed) << "the share is a bound of what was seen";
  EXPECT_GT(wrong.observed, 100 * right.observed);
}

/// What is no number is not counted as none.
TEST(Attribution, blamesTheModelForTorquesThatAreNoNumbers) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.simulation.samples = 5;
  Subject subject = solverOf(scenario);
  subject.torques = [right = subject.torques](const Motion<double>& motion) {
    Vector6d torques = right(motion);
    torques(3) = std::nan("");
    return torques;
  };
  const ValidationResult result = validate(scenario, subject);
  EXPECT_EQ(result.verdict, Verdict::fail);
  std::map<std::string, std::string> findings(result.findings.begin(), result.findings.end());
  EXPECT_EQ(findings["dominant error"], "model");
  EXPECT_EQ(findings["torque error, relative to the largest"], "nan");
}

}  // namespace
}  // namespace ursula
