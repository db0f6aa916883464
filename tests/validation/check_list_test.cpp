// Every check is in every result, in one order, and is judged or not applicable with the reason.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/check_catalogue.h"
#include "model/instants.h"
#include "report/files/report.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/families.h"
#include "validation/checks/judges.h"
#include "validation/validate.h"

namespace ursula {
namespace {

Scenario quick(const std::string& name) { return scenarioOf(name, 31); }

/// Every part of a validation of the helix, whose reference all tests share.
ValidationResult resultOf(const Subject& subject) {
  ValidationOptions options;
  options.reference = referenceOf("paper-helix", 31);
  return validate(quick("paper-helix"), subject, options);
}

void expectEveryCheck(const ValidationResult& result) {
  ASSERT_EQ(result.checks.size(), checkCatalogue().size());
  std::size_t applicable = 0;
  for (std::size_t k = 0; k < result.checks.size(); ++k) {
    const Check& check = result.checks[k];
    EXPECT_EQ(check.name, checkCatalogue()[k].name);
    applicable += check.verdict != Verdict::not_applicable;
    if (check.verdict == Verdict::not_applicable) {
      EXPECT_NE(check.why, "") << check.name;
      EXPECT_TRUE(std::isnan(check.value)) << check.name;
    } else {
      EXPECT_EQ(check.unit, checkCatalogue()[k].unit) << check.name;
    }
  }
  EXPECT_GT(applicable, 10u);
  EXPECT_EQ(judgedCount(result.checks), static_cast<std::ptrdiff_t>(applicable));
}

/// A check's name connects its words with its function.
TEST(CheckList, hasOneFamilyForEachRowOfTheCatalogue) {
  std::vector<std::string> judged;
  for (const CheckFamily& family : checkFamilies())
    judged.insert(judged.end(), family.checks.begin(), family.checks.end());
  ASSERT_GT(judged.size(), 30u);
  EXPECT_THAT(judged, testing::UnorderedElementsAreArray(namesOfChecks()));
}

TEST(CheckList, refusesACheckWithoutARow) {
  ValidationResult result;
  result.checks.emplace_back();
  result.checks.back().name = "torque.unheard_of";
  EXPECT_THROW(listEveryCheck(quick("paper-helix"), {}, result), std::logic_error);
  result.checks.back().name = "torque.twin";
  listEveryCheck(quick("paper-helix"), {}, result);
  EXPECT_EQ(result.checks.size(), checkCatalogue().size());
}

TEST(CheckList, isWholeForTheSolver) {
  for (const char* name : {"paper-helix", "proving-ground"}) {
    const ValidationResult result = validate(quick(name));
    expectEveryCheck(result);
    EXPECT_EQ(result.verdict, Verdict::pass);
    EXPECT_EQ(verdictOf(result.checks, "torque.against_noc"), "not_applicable");
  }
}

TEST(CheckList, isWholeForTorquesAlone) {
  const ValidationResult result = resultOf(torquesAlone(quick("paper-helix")));
  expectEveryCheck(result);
  for (const char* name : {"kinematics.positions", "direct.off_path", "invariance.mass"})
    EXPECT_EQ(verdictOf(result.checks, name), "not_applicable") << name;
  EXPECT_EQ(result.verdict, Verdict::pass);
}

TEST(CheckList, isWholeForAFile) {
  const Scenario scenario = quick("paper-helix");
  TorqueFile file;
  file.file = "mine.csv";
  const Subject solver = solverOf(scenario);
  for (double t : equallySpaced(scenario.trajectory->duration(), 301)) {
    file.t.push_back(t);
    file.torques.push_back(solver.torques(scenario.trajectory->at(t)));
  }
  file.time_precision.assign(file.t.size(), 0);
  file.torque_precision.assign(file.t.size(), Vector6d::Zero());
  const ValidationResult result = validateExternal(scenario, file);
  expectEveryCheck(result);
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_EQ(verdictOf(result.checks, "torque.against_noc"), "pass");
  EXPECT_EQ(verdictOf(result.checks, "torque.between"), "not_applicable");
}

TEST(CheckList, ofNothingJudgedIsNoPass) {
  EXPECT_EQ(overall({notApplicable("torque.mujoco", "N m", "this build has no MuJoCo")}), Verdict::fail);
  EXPECT_EQ(overall({notApplicable("torque.mujoco", "N m", "none"), judged("a", 0, 1, "", "", "")}), Verdict::pass);
}

/// Under torques 1 % too large the machine leaves its path, and later there is nothing to show.
TEST(CheckList, whatWasNotComputedIsNotShown) {
  const ValidationResult result = resultOf(scaledTorques(solverOf(quick("paper-helix")), 1.01));
  EXPECT_EQ(result.verdict, Verdict::fail);
  const std::vector<double>* error = result.timeseries.find("error_p_m");
  ASSERT_NE(error, nullptr);
  EXPECT_TRUE(std::isfinite(error->front()));
  EXPECT_TRUE(std::isnan(error->back()));
  EXPECT_TRUE(std::isfinite(result.timeseries.find("tau_1_Nm")->back()));
  std::string stopped;
  for (const Finding& finding : result.findings)
    if (finding.name == "replay stopped") stopped = textOf(finding);
  EXPECT_THAT(stopped, testing::HasSubstr("stopped at t = "));
}

}  // namespace
}  // namespace ursula
