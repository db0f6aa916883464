// Machines and motions at the edges of what can be judged: exact torques pass there, too, and wrong ones fail.

#include <gtest/gtest.h>

#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

class Extremes : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = [] {
    Scenario read = scenarioOf(GetParam());
    read.simulation.samples = 31;  // for speed
    return read;
  }();
};

TEST_P(Extremes, exactTorquesPass) {
  const ValidationResult result = validate(scenario_);
  EXPECT_EQ(others(result.checks, Verdict::pass), "");
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_GT(findCheck(result.checks, "feedback.torque")->value, 0);
}

TEST_P(Extremes, aMillionthTooMuchFails) {
  Subject subject = solverOf(scenario_);
  subject.torques = [right = subject.torques](const Motion<double>& motion) {
    return Vector6d((1 + 1e-6) * right(motion));
  };
  const ValidationResult result = validate(scenario_, subject, {false, false});
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "fail");
  EXPECT_EQ(verdictOf(result.checks, "feedback.torque"), "fail");
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Extremes,
                         testing::Values("light-legs", "light-platform", "millimetres", "near-singular", "helix-0.3s",
                                         "helix-60s"),
                         [](const auto& name) { return asTestName(name.param); });

}  // namespace
}  // namespace ursula
