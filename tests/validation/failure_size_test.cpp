// How large wrong efforts are: rounding, another idealisation of the machine, or wrong; and what makes them right.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/files/report.h"
#include "report/files/written_files.h"
#include "tests/support/changed.h"
#include "tests/validation/external_torques.h"
#include "tests/validation/scenario_files.h"
#include "validation/validate.h"

namespace ursula {
namespace {

using testing::HasSubstr;

constexpr int rows = 61;

/// The verdict on the right efforts of another machine, of which `change` makes others.
ValidationResult judged(
    const Scenario& scenario, const MachineChange& other,
    const std::function<void(std::size_t k, Vector6d&)>& change = [](std::size_t, Vector6d&) {}) {
  const GivenTorques given{"other.csv", equallySpaced(scenario.trajectory->duration(), rows),
                           exactTorques(changed(scenario, other), rows).changed(change).torques};
  return validateExternal(scenario, torqueFileOf(given, scenario.manipulator->motors()));
}

void spinsFreely(ManipulatorParameters& machine) {
  for (Leg& leg : machine.legs) leg.spins = true;
}
void doesNotRub(ManipulatorParameters& machine) {
  for (Leg& leg : machine.legs) leg.friction = {};
}

/// "key=value" of each change.
std::vector<std::string> remedyOf(const ValidationResult& result) {
  std::vector<std::string> out;
  if (result.size)
    for (const auto& [key, value] : result.size->remedy) out.push_back(key + "=" + value);
  return out;
}

TEST(FailureSize, isAModellingDifferenceIfTheLegsOwnSpinIsLeftOut) {
  const Scenario scenario = scenarioOf("flight-simulator");
  const ValidationResult result = judged(scenario, spinsFreely);
  EXPECT_EQ(result.verdict, Verdict::fail);
  ASSERT_TRUE(result.size);
  EXPECT_EQ(result.size->grade, FailureGrade::modelling);
  EXPECT_THAT(remedyOf(result), testing::ElementsAre("manipulator.leg_defaults.spin=free"));
  EXPECT_THAT(report::sentence(result), HasSubstr("With spin = \"free\" in [manipulator.leg_defaults]"));
  EXPECT_THAT(report::summaryJson(result), HasSubstr("\"grade\": \"modelling\""));
  Scenario free = changed(scenario, spinsFreely);
  EXPECT_EQ(judged(free, [](ManipulatorParameters&) {}).verdict, Verdict::pass) << "with what the remedy says";
  EXPECT_THAT(remedyOf(judged(free,
                              [](ManipulatorParameters& machine) {
                                for (Leg& leg : machine.legs) leg.spins = false;
                              })),
              testing::ElementsAre("manipulator.leg_defaults.spin=held"));
  Scenario tolerant = scenario;
  tolerant.tolerance = EffortTolerance{result.deviation->smallestRelative(), 0};
  EXPECT_EQ(judged(tolerant, spinsFreely).verdict, Verdict::pass) << "and with the tolerance";
}

TEST(FailureSize, namesAllKeysThatAreNeeded) {
  const Scenario scenario = scenarioOf("ups-friction-load");
  EXPECT_THAT(
      remedyOf(judged(scenario,
                      [](ManipulatorParameters& machine) {
                        spinsFreely(machine);
                        doesNotRub(machine);
                      })),
      testing::UnorderedElementsAre("manipulator.leg_defaults.spin=free", "manipulator.leg_defaults.friction={}"));
}

TEST(FailureSize, isWrongIfItExceedsATermAndNothingElseFits) {
  const Scenario scenario = scenarioOf("flight-simulator");
  for (const ValidationResult& result :
       {judged(scenario, [](ManipulatorParameters& machine) { machine.platform.mass *= 1.01; }),
        judged(scenario,
               [](ManipulatorParameters& machine) {
                 spinsFreely(machine);
                 machine.platform.mass *= 1.01;
               }),
        judged(scenario, spinsFreely, [](std::size_t, Vector6d& tau) { std::swap(tau(0), tau(1)); })}) {
    ASSERT_TRUE(result.size);
    EXPECT_EQ(result.size->grade, FailureGrade::wrong);
    EXPECT_TRUE(result.size->remedy.empty());
    EXPECT_EQ(remedyText(result), "");
  }
}

/// Twice the limit is what another order of operations makes; a millionth is not, and no term of the equations either.
TEST(FailureSize, isRoundingUpToOneMoreConditionNumber) {
  const Scenario scenario = scenarioOf("flight-simulator");
  const auto same = [](ManipulatorParameters&) {};
  const ValidationResult right = judged(scenario, same);
  EXPECT_EQ(right.verdict, Verdict::pass);
  EXPECT_FALSE(right.size);
  const std::vector<double>* limits = right.timeseries.find("limit_tau_N");
  ASSERT_NE(limits, nullptr);
  const ValidationResult little = judged(scenario, same, [&](std::size_t k, Vector6d& tau) {
    tau(static_cast<Eigen::Index>(k % 6)) += (k % 2 == 0 ? 1.5 : -1.5) * (*limits)[k];
  });
  ASSERT_TRUE(little.size) << name(little.verdict);
  EXPECT_EQ(little.size->grade, FailureGrade::rounding);
  EXPECT_GT(little.size->rounding, 1);
  const ValidationResult more =
      judged(scenario, same, [](std::size_t k, Vector6d& tau) { tau(2) *= 1 + 1e-9 * std::sin(double(k)); });
  ASSERT_TRUE(more.size);
  EXPECT_EQ(more.size->grade, FailureGrade::modelling);
  EXPECT_TRUE(more.size->remedy.empty());
  EXPECT_FALSE(more.size->least_term.empty());
}

}  // namespace
}  // namespace ursula
