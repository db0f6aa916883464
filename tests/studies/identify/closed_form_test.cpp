#include <gtest/gtest.h>

#include <cstdlib>

#include "studies/identify/identify.h"
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
