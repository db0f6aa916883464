// The measured sources of the replay's error: they add up, the rest is within the uncertainty, and the cause is named.

#include "validation/findings/attribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "tests/support/matchers.h"
#include "tests/support/whole.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/reference.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {
namespace {

std::vector<std::pair<std::string, std::string>> texts(const ValidationResult& result) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Finding& finding : result.findings) out.emplace_back(finding.name, textOf(finding));
  return out;
}

using testing::Contains;
using testing::Pair;

using StateFault = std::function<void(double t, std::vector<double>& x)>;
constexpr int budget_samples = 61;  ///< few, for speed

/// Replays the windows of the right torques under changed torques, with a falsified state if `fault` has one.
ErrorBudget budgetOf(const std::string& name, const TorqueChange& change = nullptr, const StateFault& fault = nullptr) {
  const Reference& reference = *referenceOf(name, budget_samples);
  const Scenario& scenario = reference.scenario;
  const Subject subject = change ? changedTorques(solverOf(scenario), change) : solverOf(scenario);
  ReplayPlan plan = reference.replays().plan;
  plan.torques = [subject, trajectory = scenario.trajectory](double t) { return subject.torques(trajectory->at(t)); };
  std::vector<WindowedReplay> windows = reference.replays().windows;
  for (WindowedReplay& window : windows) {
    ReplaySettings settings = settingsOf(scenario, plan, window.window, 1);
    settings.fault = fault;
    window.replay = replay(scenario, plan.torques, settings);
  }
  const auto answers = runPointwise(scenario, subject, reference.instants, reference.rounding().profile);
  const ErrorBudget budget = attribute(scenario, answers, windows, &reference.replays().amplification, plan, 2);
  std::cout << name << ": observed " << budget.observed.norm() << ", model " << budget.model.error.norm()
            << ", integration " << budget.integration.error.norm() << ", rounding " << budget.rounding.error.norm()
            << ", closure " << budget.closure.error.norm() << ", unexplained " << budget.unexplained().norm() << " of "
            << budget.uncertainty() << '\n';
  return budget;
}

class Budget : public testing::TestWithParam<std::string> {};

TEST_P(Budget, isWholeAndLeavesNoMoreThanIsNotKnown) {
  const ErrorBudget budget = budgetOf(GetParam());
  ASSERT_TRUE(budget.measured);
  EXPECT_GT(budget.observed.norm(), 0);
  const Vector3d sum = budget.model.error + budget.integration.error + budget.rounding.error + budget.closure.error +
                       budget.unexplained();
  const double size = budget.observed.norm() + budget.model.error.norm() + budget.rounding.error.norm() +
                      budget.closure.error.norm() + budget.integration.error.norm();
  EXPECT_LE((sum - budget.observed).norm(), 4 * Eigen::NumTraits<double>::epsilon() * size);
  EXPECT_LE(budget.unexplained().norm(), budget.uncertainty());
  EXPECT_NE(budget.dominant, ErrorSource::model) << "the torques are right";
  // Beside rounding, the uncertainty must be at most a few times the error, and with it unless the error is far below
  // what rounding may do, as near a singularity.
  EXPECT_LT(budget.uncertainty() - budget.model_rounding, 100 * std::max(size, 1e-15));
  if (budget.observed.norm() > std::max(1e-13, budget.model_rounding / 100)) {
    EXPECT_LT(budget.uncertainty(), 100 * size);
  }
}

/// Every kind of leg, units and sizes, friction and loads, motions from a third of a second to ten, near singularities.
std::vector<std::string> budgeted() {
  if (wholeAsked()) return shippedScenarios();
  return {"paper-helix",   "flight-simulator", "hexa",      "hexaglide",  "three-legs",
          "millimetres",   "helix-0.3s",       "helix-10s", "load-table", "near-singular",
          "ups-near-edge", "viscous-friction", "waypoints", "hold",       "light-legs",
          "gravity-off"};
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Budget, testing::ValuesIn(budgeted()),
                         [](const auto& name) { return asTestName(name.param); });

TEST(Attribution, namesTheModelWhereTorquesAreOffByAMillionth) {
  for (const char* name : {"paper-helix", "millimetres"}) {
    const ErrorBudget wrong =
        budgetOf(name, [](const auto&, const Vector6d& torques) { return Vector6d((1 + 1e-6) * torques); });
    EXPECT_EQ(wrong.dominant, ErrorSource::model) << name;
    EXPECT_GT(wrong.observed.norm(), 1000 * budgetOf(name).observed.norm());
    EXPECT_LE((wrong.model.error - wrong.observed).norm(), 0.1 * wrong.observed.norm()) << "carried, not bounded";
    EXPECT_LE(wrong.unexplained().norm(), wrong.uncertainty());
  }
}

TEST(Attribution, namesTheModelWhereOneLegIsOffByABillionth) {
  const ErrorBudget wrong = budgetOf("paper-helix", [](const auto&, Vector6d torques) {
    torques(4) *= 1 + 1e-9;
    return torques;
  });
  EXPECT_EQ(wrong.dominant, ErrorSource::model);
  EXPECT_LE(wrong.unexplained().norm(), wrong.uncertainty());
}

/// Even if the variational equations no longer hold, the torques moved the replay.
TEST(Attribution, namesTheModelWhereTheMotionIsLost) {
  const ErrorBudget wrong = budgetOf("paper-helix", [](const auto&, Vector6d torques) {
    torques(2) *= 1.001;
    return torques;
  });
  EXPECT_GT(wrong.observed.norm(), 0.01) << "nothing was lost";
  EXPECT_EQ(wrong.dominant, ErrorSource::model);
}

/// A state that is falsified after each step is not an error of the torques.
TEST(Attribution, doesNotNameTheModelWhereTheIntegratorIsFaulty) {
  const ErrorBudget faulty = budgetOf("paper-helix", nullptr, [](double, std::vector<double>& x) {
    for (double& each : x) each *= 1 + 1e-11;
  });
  EXPECT_NE(faulty.dominant, ErrorSource::model);
  EXPECT_GT(faulty.observed.norm(), 10 * budgetOf("paper-helix").observed.norm()) << "nothing was falsified";
  EXPECT_LT(faulty.model.error.norm(), 0.1 * faulty.observed.norm());
}

/// The analysed replay is the one with the largest end error.
TEST(Attribution, looksAtTheWindowThatEndsFurthestOff) {
  const Reference& reference = *referenceOf("helix-10s", budget_samples);
  ASSERT_GE(reference.replays().windows.size(), 3u);
  double furthest = 0, t = 0;
  for (const WindowedReplay& window : reference.replays().windows)
    if (window.replay.steps.back().position_error.norm() > furthest) {
      furthest = window.replay.steps.back().position_error.norm();
      t = window.replay.steps.back().t;
    }
  const ErrorBudget budget = budgetOf("helix-10s");
  EXPECT_EQ(budget.t, t);
  EXPECT_EQ(budget.observed.norm(), furthest);
  EXPECT_LE(budget.unexplained().norm(), budget.uncertainty());
}

TEST(Attribution, comesOutTheSameTwice) {
  const ErrorBudget a = budgetOf("paper-helix"), b = budgetOf("paper-helix");
  for (ErrorShare ErrorBudget::*share :
       {&ErrorBudget::model, &ErrorBudget::integration, &ErrorBudget::rounding, &ErrorBudget::closure}) {
    EXPECT_EQ((a.*share).error, (b.*share).error);
    EXPECT_EQ((a.*share).uncertainty, (b.*share).uncertainty);
  }
}

TEST(Attribution, withoutAReplayNothingIsMeasured) {
  const Reference& reference = *referenceOf("paper-helix", budget_samples);
  const ErrorBudget none =
      attribute(reference.scenario, {}, {}, &reference.replays().amplification, reference.replays().plan, 2);
  EXPECT_FALSE(none.measured);
  ValidationResult result;
  addBudget(none, result);
  EXPECT_THAT(result.findings, testing::IsEmpty());
  EXPECT_FALSE(result.replay_error);
  result.checks = {judged("kinematics.positions", 2, 1, "m", "", "")};
  addBudget(none, result);
  EXPECT_THAT(texts(result), testing::ElementsAre(Pair("dominant error", "model")));
}

ErrorBudget madeBudget() {
  ErrorBudget budget;
  budget.measured = true;
  budget.t = 3;
  budget.observed = {4e-11, 0, 3e-11};
  budget.integration = {{3e-11, 0, 0}, 1e-12};
  budget.rounding = {{0, 0, 2e-11}, 2e-12};
  budget.closure = {{0, 1e-12, 0}, 4e-12};
  budget.model = {{1e-13, 0, 0}, 5e-12};
  budget.amplification = 1000;
  budget.dominant = ErrorSource::integration;
  return budget;
}

Check unjudged(const std::string& name, Reason reason) { return notJudgeable(reason, name, 1, 2, "m", "basis", "why"); }

TEST(Budgets, becomeFindings) {
  ValidationResult result;
  addBudget(madeBudget(), result, {2, 3, 0.5});
  EXPECT_THAT(texts(result), Contains(Pair("dominant error", "integration")));
  EXPECT_THAT(texts(result), Contains(Pair("replay, error in position", "1e-10 m at t = 1.5 s")));
  EXPECT_THAT(texts(result), Contains(Pair("of it by rounding", "4e-11 m +- 4e-12 m")));
  EXPECT_THAT(texts(result), Contains(Pair("of it by the integration", "6e-11 m +- 2e-12 m")));
  EXPECT_THAT(texts(result), Contains(Pair("of it by the loops' gaps", "2e-12 m +- 8e-12 m")));
  EXPECT_THAT(texts(result), Contains(Pair("of it by the torques", "2e-13 m +- 1e-11 m")));
  EXPECT_THAT(texts(result), Contains(Pair("of it unexplained", HasSubstr("m +- 2.4e-11 m"))));
  EXPECT_THAT(texts(result), Contains(Pair("amplification of a deviation at the start", "1000")));
}

/// If errors no longer add up, they are not told apart, and the torques are blamed instead of the gaps.
TEST(Budgets, blameWrongTorquesAloneWhereSourcesDoNotAddUp) {
  const auto found = [](Verdict of_torques) {
    ErrorBudget budget = madeBudget();
    budget.observed = {0.7, 0, 0};
    budget.closure = {{0.6, 0, 0}, 0.003};
    budget.model = {{2.9, 0, 0}, 2.9};
    ValidationResult result;
    result.checks = {judged("torque.pointwise", of_torques == Verdict::fail ? 2 : 0.5, 1, "N m", "", "")};
    addBudget(budget, result);
    return result;
  };
  const ValidationResult wrong = found(Verdict::fail);
  EXPECT_THAT(texts(wrong), testing::ElementsAre(Pair("dominant error", "model")));
  EXPECT_TRUE(wrong.curves.empty());
  EXPECT_FALSE(wrong.replay_error->measured);
  const ValidationResult right = found(Verdict::pass);
  EXPECT_TRUE(right.replay_error->measured) << "right torques do not explain it";
  EXPECT_THAT(texts(right), Contains(Pair("of it by the loops' gaps", "0.6 m +- 0.003 m")));
}

TEST(Budgets, nameAmplificationWhereItPreventsJudging) {
  const auto dominant = [](const Check& check) {
    ValidationResult result;
    result.checks = {check};
    addBudget(madeBudget(), result);
    return textOf(result.findings.front());
  };
  EXPECT_EQ(dominant(unjudged("replay.position", Reason::limit_useless)), "amplification");
  EXPECT_EQ(dominant(unjudged("replay.orientation", Reason::limit_useless)), "amplification");
  EXPECT_EQ(dominant(unjudged("replay.position", Reason::unfinished)), "integration") << "no limit prevented that";
  EXPECT_EQ(dominant(unjudged("feedback.torque", Reason::limit_useless)), "integration") << "that is no amplification";
  EXPECT_EQ(dominant(notMade("replay.position", "m", "gave up")), "integration") << "a failure prevents nothing";
}

/// NaN does not count as zero.
TEST(Attribution, blamesTheModelForTorquesThatAreNoNumbers) {
  const Scenario scenario = scenarioOf("paper-helix", 5);
  const Subject subject = changedTorques(solverOf(scenario), [](const auto&, Vector6d torques) {
    torques(3) = std::nan("");
    return torques;
  });
  const ValidationResult result = validate(scenario, subject, {false, false});
  EXPECT_EQ(result.verdict, Verdict::fail);
  std::map<std::string, std::string> findings;
  for (const auto& [name, text] : texts(result)) findings.emplace(name, text);
  EXPECT_EQ(findings["dominant error"], "model");
  EXPECT_TRUE(std::isnan(result.deviation.value().relative()));
}

}  // namespace
}  // namespace ursula
