// Every function refuses a scenario without a machine or a motion, such as a moved-from one.

#include <gtest/gtest.h>

#include <utility>

#include "tests/model/refusals.h"
#include "tests/support/matchers.h"
#include "tests/support/vectors.h"
#include "validation/outside/outside_solver.h"
#include "validation/validate.h"

namespace ursula {
namespace {

void expectRefused(const Scenario& scenario, const char* says) {
  const auto expect = [says](const auto& call) { EXPECT_THAT(refusal<InvalidParameter>(call), HasSubstr(says)); };
  expect([&] { validate(scenario); });
  expect([&] { validate(scenario, Subject{}); });
  expect([&] { validateOutside(scenario, OutsideSolver{}); });
  expect([&] { validatePointwise(scenario); });
  expect([&] { validateExternal(scenario, TorqueFile{}); });
  expect([&] { validateExternal(scenario, "no-such.csv"); });
  expect([&] { makeReference(scenario); });
  expect([&] { estimatedSeconds(scenario); });
}

TEST(UnmadeScenario, isRefused) {
  expectRefused({}, "manipulator: none, expected a scenario that has one");
  Scenario half = vectorScenario("paper-helix");
  half.trajectory = nullptr;
  expectRefused(half, "trajectory: none, expected a scenario that has one");
}

TEST(UnmadeScenario, isWhatWasMovedFrom) {
  Scenario from = vectorScenario("paper-helix");
  const Scenario to = std::move(from);
  expectRefused(from, "manipulator: none");  // NOLINT(bugprone-use-after-move)
  EXPECT_GT(estimatedSeconds(to), 0);
}

}  // namespace
}  // namespace ursula
