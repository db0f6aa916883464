#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "parts/identify/identify.h"
#include "tests/studies/identify/synthetic_log.h"

namespace ursula {
namespace {

const char* const machines[] = {"hexaglide", "paper-helix", "flight-simulator"};

Scenario scenarioOf(const std::string& name) { return readScenario(URSULA_SCENARIOS "/" + name + ".toml"); }

/// URSULA_LOGS sets the number of logs for each machine and noise.
unsigned closedFormLogs() {
  const char* asked = std::getenv("URSULA_LOGS");
  return asked == nullptr ? 1 : static_cast<unsigned>(std::atoi(asked));
}

/// The scenarios have no tolerances, so only noise and the low passes stand between model and log.
TEST(ClosedFormLogs, rightModelsPassWithNoiseAndWithoutAny) {
  for (const char* const name : machines)
    for (const double noise : {0.0, 1.0, 20.0})
      for (unsigned seed = 1; seed <= closedFormLogs(); ++seed) {
        const Scenario scenario = scenarioOf(name);
        const IdentifyResult result = identify(scenario, logOf(closedFormRows(scenario, 1501, noise, seed), scenario));
        EXPECT_EQ(result.verdict, Verdict::pass) << name << ", noise of " << noise << "\n" << identifyText(result);
        for (const MotorAgreement& motor : result.motors) EXPECT_GT(motor.u_val, 0) << name;
      }
}

/// The helix is slow and ends near a singular pose, so encoders' noise dominates the columns of inertias. Without the
/// share that columns and residual have in common, intervals there hold nothing; the wrong numbers show that here.
TEST(ClosedFormLogs, intervalsHoldOnTheHelixUnderNoiseOfEncoders) {
  const Scenario scenario = scenarioOf("paper-helix");
  int held = 0, all = 0, wide = 0;
  for (const double noise : {2e-6, 1e-5, 1e-4}) {
    SyntheticRows rows = closedFormRows(scenario, 1501, 20, 1);
    std::mt19937 dice(2);
    std::normal_distribution<double> normal(0, noise);
    for (double& each : rows.motion.reshaped()) each += normal(dice);
    const IdentifyResult result = identify(scenario, logOf(rows, scenario));
    EXPECT_EQ(result.verdict, Verdict::pass) << noise << "\n" << identifyText(result);
    EXPECT_LE(std::abs(result.delay), 4 * result.delay_uncertainty) << noise;
    for (const MeasuredNumber& each : result.combinations) {
      if (each.group == "delay") continue;
      const double off = std::abs(each.value - each.nominal);
      ++all;
      held += off <= 1.96 * each.uncertainty ? 1 : 0;
      wide += off > 0.2 * std::abs(each.nominal) ? 1 : 0;
    }
  }
  ASSERT_GT(all, 100);
  EXPECT_GT(held, 0.95 * all) << held << " of " << all;
  EXPECT_GT(wide, all / 4) << "the numbers are right anyway, so the test shows nothing";
}

TEST(ClosedFormLogs, massThatIsSlightlyOffFails) {
  for (const char* const name : machines) {
    const Scenario scenario = scenarioOf(name);
    ManipulatorParameters heavier = scenario.manipulator->parameters();
    heavier.platform.mass *= 1.01;
    Scenario other = scenario;
    other.manipulator = std::make_shared<Manipulator>(heavier);
    const IdentifyResult result = identify(scenario, logOf(closedFormRows(other, 1501, 1, 1), scenario));
    EXPECT_EQ(result.verdict, Verdict::fail) << name << "\n" << identifyText(result);
  }
}

/// Without noise, what is beyond the linearisation exceeds all noise, and would be taken for an offset of a joint.
TEST(ClosedFormLogs, massIsTheFirstCauseWithoutNoise) {
  const Scenario scenario = scenarioOf("hexaglide");
  ManipulatorParameters heavier = scenario.manipulator->parameters();
  heavier.platform.mass *= 1.05;
  Scenario other = scenario;
  other.manipulator = std::make_shared<Manipulator>(heavier);
  const IdentifyResult result = identify(scenario, logOf(closedFormRows(other, 1501, 0, 1), scenario));
  ASSERT_FALSE(result.causes.empty()) << identifyText(result);
  EXPECT_EQ(result.causes.front().parameter, "manipulator.platform.mass") << identifyText(result);
  EXPECT_GT(result.causes.front().explained, 0.99);
}

}  // namespace
}  // namespace ursula
