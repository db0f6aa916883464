// All of `ursula prove`: every defect is caught, and every check catches one that earlier checks do not.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "parts/engines/mujoco/mujoco_loop.h"
#include "parts/prove/prove.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

/// On machines without friction or load, some defects change nothing, and some checks have nothing to catch.
class ProofOf : public testing::TestWithParam<const char*> {};

/// An error of 1e-9 per step is smaller than the error of a coarse rung of this machine's ladder.
bool isBelowWhatShows(const std::string& scenario, const std::string& defect) {
  return scenario == "hexaglide" && defect == "coarser replays falsified by 1e-9 after each step";
}

TEST_P(ProofOf, catchesEveryDefect) {
  const DefectProof proof = proveDefects(scenarioOf(GetParam()), 2, [](int) {});
  EXPECT_TRUE(proof.without_defect.empty()) << "the right solver fails " << proof.without_defect.front();
  int shown = 0;
  for (const DefectOutcome& outcome : proof.outcomes) {
    if (!mujocoAvailable() && outcome.name.rfind("MuJoCo", 0) == 0) continue;
    shown += outcome.shows;
    if (!outcome.shows || isBelowWhatShows(GetParam(), outcome.name)) continue;
    EXPECT_TRUE(outcome.caught()) << outcome.name << ", on " << outcome.formulations() << " of "
                                  << outcome.formulations_wanted;
  }
  EXPECT_GE(shown, 100);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ProofOf,
                         testing::Values("flight-simulator", "ups-friction-load", "hexa", "hexaglide", "mixture",
                                         "three-legs"),
                         [](const auto& scenario) {
                           std::string name = scenario.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// This is one test, because it is slow; all of it is from one run.
TEST(Proof, catchesEveryDefectAndNeedsEveryCheck) {
  const DefectProof proof = proveDefects(scenarioOf("proving-ground"), 2, [](int) {});
  EXPECT_TRUE(proof.without_defect.empty()) << "the right solver fails " << proof.without_defect.front();
  EXPECT_GE(proof.outcomes.size(), 150u);
  for (const DefectOutcome& outcome : proof.outcomes) {
    if (!mujocoAvailable() && outcome.name.rfind("MuJoCo", 0) == 0) continue;
    EXPECT_TRUE(outcome.shows) << outcome.name;
    EXPECT_TRUE(outcome.caught()) << outcome.name << ", on " << outcome.formulations() << " of "
                                  << outcome.formulations_wanted;
  }
  EXPECT_EQ(proof.checks.size(), mujocoAvailable() ? 36u : 35u);
  for (const CheckProof& check : proof.checks)
    EXPECT_FALSE(check.alone.empty() && check.first.empty()) << check.check << " catches nothing first";
}

}  // namespace
}  // namespace ursula
