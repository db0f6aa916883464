// The core gives a full verdict of the NOC against Simbody without any part, and says what parts would add.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"
#include "validation/blind_spots.h"
#include "validation/checks/families.h"
#include "validation/likely_cause.h"
#include "validation/limits/further_engines.h"
#include "validation/validate.h"

namespace ursula {
namespace {

Scenario helix() {
  Scenario scenario = readScenario(std::string(URSULA_SCENARIOS) + "/paper-helix.toml");
  scenario.simulation.samples = 21;
  return scenario;
}

const Check& named(const ValidationResult& result, const std::string& name) {
  return *std::find_if(result.checks.begin(), result.checks.end(),
                       [&name](const Check& check) { return check.name == name; });
}

TEST(Core, hasNoRowOfAPart) {
  EXPECT_EQ(furtherEngines().size(), 1u) << "Simbody's own second tree";
  EXPECT_EQ(partLikelyCause(), nullptr);
  EXPECT_EQ(partBlindSpots(), nullptr);
  EXPECT_EQ(partModelReader(), nullptr);
  EXPECT_TRUE(partFamilies().empty());
  EXPECT_FALSE(checkFamilies().empty());
}

TEST(Core, judgesTheHelixAlone) {
  const ValidationResult result = validate(helix());
  EXPECT_EQ(result.verdict, Verdict::pass);
  const auto passed = std::count_if(result.checks.begin(), result.checks.end(),
                                    [](const Check& check) { return check.verdict == Verdict::pass; });
  EXPECT_GE(passed, 30);
  for (const char* of_part : {"torque.maximal", "torque.mujoco", "fast.inverse", "fast.direct_batch"}) {
    EXPECT_EQ(named(result, of_part).verdict, Verdict::not_applicable) << of_part;
    EXPECT_THAT(named(result, of_part).why, testing::HasSubstr("./dev build")) << of_part;
  }
}

/// A control: efforts that are off by a billionth fail, at the samples and between them.
TEST(Core, failsWrongEfforts) {
  const Scenario scenario = helix();
  const ValidationResult result = validateMade(scenario, [](const Scenario& here) {
    Subject subject = nocSubject(*here.manipulator, here.load);
    subject.torques = [right = subject.torques](const Motion<double>& motion) {
      return Vector6d(right(motion) * (1 + 1e-9));
    };
    return subject;
  });
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_EQ(named(result, "torque.pointwise").verdict, Verdict::fail);
  EXPECT_EQ(named(result, "torque.between").verdict, Verdict::fail);
}

}  // namespace
}  // namespace ursula
