#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "base/csv.h"
#include "parts/identify/excite.h"
#include "parts/identify/identify.h"
#include "tests/studies/identify/paper_machine_log.h"
#include "tests/studies/identify/random_logs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const MeasuredNumber& numberOf(const IdentifyResult& result, const std::string& name) {
  for (const MeasuredNumber& each : result.numbers)
    if (each.name == name) return each;
  throw std::out_of_range(name);
}

bool hasFinding(const IdentifyResult& result, const std::string& kind) {
  return std::any_of(result.findings.begin(), result.findings.end(),
                     [&](const LogFinding& each) { return each.kind == kind; });
}

TEST_F(Identify, rightModelIsWithinItsUncertainty) {
  how.delay = 2.3 / how.rate;
  const IdentifyResult result = run();
  EXPECT_EQ(result.verdict, Verdict::pass) << identifyText(result);
  EXPECT_EQ(result.periods, 2);
  EXPECT_NEAR(result.delay * how.rate, 2.3, 0.1);
  EXPECT_FALSE(hasFinding(result, "near_singular"));
  EXPECT_GT(result.combinations.size(), 20U);
  EXPECT_LT(result.validation_fitted, 1.5);
  EXPECT_GT(result.validation_fitted, 0.5);
  for (const MotorAgreement& motor : result.motors) {
    EXPECT_GT(motor.u_D, 0);
    EXPECT_GT(motor.u_input, 0);
    EXPECT_LT(motor.left, 0.01 * motor.effort);
  }
}

/// This hexaglide passes a pose at which noise of 2 µm makes 40 times the usual noise of the efforts.
TEST(IdentifyNearSingularPoses, instantsThereAreLeftOutAndRightModelPasses) {
  const RandomLog log = randomLog(56);
  IdentifyOptions options;
  options.tolerances = log.tolerances;
  const IdentifyResult result = identify(log.model, logOf(log.rows, log.model), options);
  EXPECT_TRUE(hasFinding(result, "near_singular")) << identifyText(result);
  EXPECT_EQ(result.verdict, Verdict::pass) << identifyText(result);
  EXPECT_GT(result.instants, 24);
}

/// Noise of the motion makes most of these efforts' noise, and stood in the columns too: the scale of an effort looked
/// wrong by 1 %.
TEST(IdentifyNoisyMotion, rightModelPasses) {
  const RandomLog log = randomLog(194);
  IdentifyOptions options;
  options.tolerances = log.tolerances;
  const IdentifyResult result = identify(log.model, logOf(log.rows, log.model), options);
  EXPECT_EQ(result.verdict, Verdict::pass) << identifyText(result);
}

TEST_F(Identify, wrongMassIsNamedWithItsTolerancesAndFound) {
  truth.platform.mass *= 1.05;
  const IdentifyResult result = run();
  ASSERT_EQ(result.verdict, Verdict::fail);
  ASSERT_FALSE(result.causes.empty());
  EXPECT_EQ(result.causes[0].parameter, "manipulator.platform.mass") << identifyText(result);
  EXPECT_NEAR(result.causes[0].tolerances, 5, 1);
  const MeasuredNumber& mass = numberOf(result, "manipulator.platform.mass");
  EXPECT_TRUE(mass.identified);
  EXPECT_LE(mass.low, 525);
  EXPECT_GE(mass.high, 525);
}

TEST_F(Identify, elasticJointIsNamed) {
  const IdentifyResult result = runWithCompliance();
  ASSERT_EQ(result.verdict, Verdict::fail) << identifyText(result);
  ASSERT_FALSE(result.causes.empty());
  EXPECT_EQ(result.causes[0].kind, "elastic_joint") << identifyText(result);
  EXPECT_EQ(result.causes[0].motor, 3);
  EXPECT_NEAR(result.causes[0].found, 1e-7, 1e-8);
}

TEST_F(Identify, effortsOfOtherMotorsOrUnitsAreSaidToBe) {
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.efforts.col(1).swap(rows.efforts.col(4));
  const IdentifyResult swapped = identify(scenario, logOf(rows, scenario), options);
  EXPECT_EQ(swapped.verdict, Verdict::fail);
  ASSERT_FALSE(swapped.causes.empty());
  EXPECT_EQ(swapped.causes[0].kind, "order");
  rows.efforts.col(1).swap(rows.efforts.col(2));  // three in a circle
  const IdentifyResult circle = identify(scenario, logOf(rows, scenario), options);
  ASSERT_FALSE(circle.causes.empty());
  EXPECT_EQ(circle.causes[0].kind, "order");
  rows = syntheticRows(scenario, truth, how);
  rows.efforts *= 1e-3;
  const IdentifyResult scaled = identify(scenario, logOf(rows, scenario), options);
  EXPECT_TRUE(hasFinding(scaled, "units")) << identifyText(scaled);
  EXPECT_EQ(scaled.causes.size(), 1U) << "numbers fitted to other units mean nothing";
}

TEST_F(Identify, instantsInMillisecondsAreSaidToBe) {
  SyntheticRows rows = closedFormRows(scenario, 1001, 1, 1);
  EXPECT_FALSE(hasFinding(identify(scenario, logOf(rows, scenario), options), "units"));
  for (double& t : rows.t) t *= 1000;
  const IdentifyResult result = identify(scenario, logOf(rows, scenario), options);
  EXPECT_TRUE(hasFinding(result, "units")) << identifyText(result);
}

TEST_F(Identify, machineThatStandsStillIsNotJudged) {
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.motion = rows.motion.row(0).replicate(rows.motion.rows(), 1).eval();
  const IdentifyResult result = identify(scenario, logOf(rows, scenario), options);
  EXPECT_EQ(result.verdict, Verdict::inconclusive);
  EXPECT_TRUE(hasFinding(result, "still")) << identifyText(result);
}

/// The delay would take on what the offset leaves, and the offset what the wrong delay leaves.
TEST_F(Identify, offsetOfACoordinateIsNamedAndDelayStaysRight) {
  how.delay = 2.3 / how.rate;
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.motion.col(2).array() += 2e-3;
  const IdentifyResult result = identify(scenario, logOf(rows, scenario), options);
  ASSERT_EQ(result.verdict, Verdict::fail) << identifyText(result);
  ASSERT_FALSE(result.causes.empty());
  EXPECT_EQ(result.causes[0].kind, "encoder_offset") << identifyText(result);
  EXPECT_EQ(result.causes[0].motor, 3);
  EXPECT_NEAR(std::abs(result.causes[0].found), 2e-3, 4e-4);
  EXPECT_NEAR(result.delay * how.rate, 2.3, 0.2);
}

/// Single rows are lost at random, and a longer part once.
TEST_F(Identify, rightModelPassesWithLostRows) {
  SyntheticRows rows = syntheticRows(scenario, truth, how), kept = rows;
  std::mt19937 random(1);
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < rows.motion.rows(); ++k) {
    if ((k > 8 && k + 8 < rows.motion.rows() && random() % 20 == 0) || (k >= 900 && k < 960)) continue;
    kept.t[static_cast<std::size_t>(count)] = rows.t[static_cast<std::size_t>(k)];
    kept.motion.row(count) = rows.motion.row(k);
    kept.efforts.row(count++) = rows.efforts.row(k);
  }
  kept.t.resize(static_cast<std::size_t>(count));
  kept.motion.conservativeResize(count, Eigen::NoChange);
  kept.efforts.conservativeResize(count, Eigen::NoChange);
  ASSERT_LT(count, rows.motion.rows() - 200);
  const IdentifyResult result = identify(scenario, logOf(kept, scenario), options);
  EXPECT_TRUE(hasFinding(result, "drop_outs"));
  EXPECT_EQ(result.verdict, Verdict::pass) << identifyText(result);
}

/// Exact logs have no noise but rounding.
TEST_F(Identify, effortsOfZeroAreWrong) {
  how.motion_noise = how.effort_noise = 0;
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.efforts.setZero();
  const IdentifyResult result = identify(scenario, logOf(rows, scenario), options);
  EXPECT_EQ(result.verdict, Verdict::fail) << identifyText(result);
}

TEST_F(Identify, clippedEffortIsFoundAndLeftOut) {
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  const double most = 0.98 * rows.efforts.col(0).maxCoeff() + 0.02 * rows.efforts.col(0).mean();
  rows.efforts.col(0) = rows.efforts.col(0).cwiseMin(most);
  const IdentifyResult result = identify(scenario, logOf(rows, scenario), options);
  EXPECT_TRUE(hasFinding(result, "saturation"));
}

TEST_F(Identify, slowLogIsNotJudged) {
  how.rate = 10;
  const IdentifyResult result = run();
  EXPECT_NE(result.verdict, Verdict::pass) << identifyText(result);
  EXPECT_TRUE(hasFinding(result, "too_slow") || hasFinding(result, "too_short"));
}

TEST_F(Identify, coordinatesThatTheMachineCannotTakeAreRefused) {
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.motion *= 180 / std::acos(-1.0);
  try {
    identify(scenario, logOf(rows, scenario), options);
    FAIL() << "degrees were taken for radians";
  } catch (const CsvError& error) {
    EXPECT_THAT(error.what(), HasSubstr("degrees"));
  }
}

TEST_F(Identify, logOfAnotherMachineIsWrongOrRefused) {
  const Scenario other = readScenario(std::string(URSULA_SCENARIOS) + "/heavy-legs.toml");
  const IdentifyResult heavier = identify(other, logOf(syntheticRows(scenario, truth, how), scenario), options);
  EXPECT_EQ(heavier.verdict, Verdict::fail) << identifyText(heavier);
  const Scenario hexaglide = readScenario(std::string(URSULA_SCENARIOS) + "/hexaglide.toml");
  EXPECT_THROW(identify(scenario, logOf(closedFormRows(hexaglide, 501, 1, 1), scenario), options), CsvError);
}

/// The motors' coordinates are exchanged too, so legs are swapped as a whole.
TEST_F(Identify, logOfSwappedLegsIsWrongOrRefused) {
  SyntheticRows rows = syntheticRows(scenario, truth, how);
  rows.motion.col(0).swap(rows.motion.col(3));
  rows.efforts.col(0).swap(rows.efforts.col(3));
  try {
    EXPECT_EQ(identify(scenario, logOf(rows, scenario), options).verdict, Verdict::fail);
  } catch (const CsvError& error) {
    EXPECT_THAT(error.what(), HasSubstr("exchanged"));
  }
}

TEST_F(Identify, summaryAndScenarioReadBack) {
  const Scenario read = readScenario(std::string(URSULA_SCENARIOS) + "/paper-helix.toml");
  const IdentifyResult result = identify(read, logOf(syntheticRows(read, read.manipulator->parameters(), how), read));
  const auto json = nlohmann::json::parse(identifySummary(result));
  EXPECT_EQ(json["motors"].size(), 6U);
  EXPECT_GT(json["combinations"].size(), 20U);
  EXPECT_THAT(identifyPage(result), HasSubstr("Torque of motor 1"));
  const Scenario again = parseScenario(result.identified_scenario, "identified.toml");
  EXPECT_NEAR(again.manipulator->platform().mass, 500, 5);
  EXPECT_FALSE(statedTolerances(again).empty());
}

TEST_F(Identify, excitedMotionShowsMoreAndKeepsToLimits) {
  ExciteOptions limits;
  limits.tries = 40;
  limits.effort = 2e4;
  const Excitation found = excite(scenario, limits);
  EXPECT_GT(found.shown, 20);
  EXPECT_LT(found.condition, found.scenario_condition);
  EXPECT_LE(found.effort, limits.effort);
  EXPECT_THAT(found.csv, HasSubstr("t_s,p_x_m"));
}

}  // namespace
}  // namespace ursula
