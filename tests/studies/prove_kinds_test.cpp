// Defects of machines with other legs than the paper's. The lists cover everything that can be wrong, and some defects
// of telescopic legs are caught here. prove_defects_test.cpp tests all of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "parts/prove/defects.h"
#include "parts/prove/effect.h"
#include "parts/prove/prove.h"
#include "parts/wrong_formulas/wrong_noc.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/evidence/reference.h"
#include "validation/validate.h"

namespace ursula {
namespace {

class DefectsOf : public testing::TestWithParam<const char*> {};

TEST_P(DefectsOf, areManyAndOfEveryGroup) {
  const Scenario scenario = scenarioOf(GetParam());
  std::set<std::string> names;
  std::map<std::string, int> groups;
  for (const Defect& defect : allDefects(*scenario.manipulator)) {
    EXPECT_TRUE(names.insert(defect.name).second) << defect.name << " is there twice";
    ++groups[defect.group];
    EXPECT_FALSE(defect.subject && defect.scenario) << defect.name << " is put into more than one place";
  }
  EXPECT_GE(names.size(), 150u);
  EXPECT_EQ(groups.size(), 20u);
  for (const auto& [group, count] : groups) EXPECT_GE(count, group == "complement" ? 2 : 4) << group;
}

/// Every kind of leg of the machine has defects.
TEST_P(DefectsOf, areOfItsLegs) {
  const Scenario scenario = scenarioOf(GetParam());
  const std::vector<Defect> defects = allDefects(*scenario.manipulator);
  for (const Leg& leg : scenario.manipulator->parameters().legs) {
    const std::string kind = std::string(rowOf(leg.kind).name) + ": ";
    EXPECT_GE(std::count_if(defects.begin(), defects.end(),
                            [&](const Defect& defect) { return defect.name.rfind(kind, 0) == 0; }),
              8)
        << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, DefectsOf,
                         testing::Values("flight-simulator", "hexa", "hexaglide", "mixture", "three-legs"),
                         [](const auto& scenario) { return asTestName(scenario.param); });

/// Telescopic legs with friction, under a load.
const Scenario& telescopes() {
  static const Scenario scenario = scenarioOf("ups-friction-load", 31);  // for speed
  return scenario;
}

/// A term that this machine lacks changes only rounding; a term that it has changes results.
TEST(RightAnswers, areKnownFromRounding) {
  using Off = RightAnswers::Off;
  const Scenario machine = scenarioOf("flight-simulator");  // which has neither friction nor load
  const RightAnswers right(machine);
  const auto faulty = [&](FormulaError formula_error) {
    return wrongNocSubject(*machine.manipulator, machine.load, WithFormulaErrors(formula_error));
  };
  EXPECT_EQ(right.offIn(faulty(FormulaError::drop_friction)), Off::nothing);
  EXPECT_EQ(right.offIn(faulty(FormulaError::drop_gyroscopic_legs)), Off::dynamics);
  Subject off = nocSubject(*machine.manipulator, machine.load);
  EXPECT_EQ(right.offIn(off), Off::nothing);
  off.kinematics = [kinematics = off.kinematics](const Motion<double>& motion) {
    KinematicAnswer answer = kinematics(motion);
    answer.joints.q.phi *= 1 + 1e-12;
    return answer;
  };
  EXPECT_EQ(right.offIn(off), Off::kinematics);
  off.torques = [torques = off.torques](const Motion<double>& motion) {
    return Vector6d((1 + 1e-12) * torques(motion));
  };
  EXPECT_EQ(right.offIn(off), Off::dynamics);
}

TEST(SayOtherwise, knowsAnotherVerdictAndAnotherValue) {
  const std::vector<Check> right = {judged("a", 1, 8, "m", "", ""), notApplicable("b", "m", "")};
  std::vector<Check> other = right;
  EXPECT_FALSE(sayOtherwise(other, right, 0));
  other[1] = judged("b", 9, 8, "m", "", "");  // a check that does not apply says nothing
  EXPECT_FALSE(sayOtherwise(other, right, 0));
  other[0].value = 1.5;
  EXPECT_TRUE(sayOtherwise(other, right, 0));
  EXPECT_FALSE(sayOtherwise(other, right, 0.125));
  other[0] = judged("a", 9, 8, "m", "", "");
  EXPECT_TRUE(sayOtherwise(other, right, 10));
}

class UpsDefect : public testing::TestWithParam<const char*> {};

TEST_P(UpsDefect, isCaughtOnTheEnginesThatItMust) {
  const std::vector<Defect> defects = allDefects(*telescopes().manipulator);
  const auto defect =
      std::find_if(defects.begin(), defects.end(), [](const Defect& each) { return each.name == GetParam(); });
  ASSERT_NE(defect, defects.end());
  ValidationOptions options;
  options.budget = false;
  options.reference = referenceOf("ups-friction-load", 31);
  DefectOutcome outcome{defect->name, defect->group, {}, defect->formulations_wanted, true, ""};
  for (const Check& check : validateMade(telescopes(), defect->subject, options).checks)
    if (check.verdict == Verdict::fail) outcome.caught_by.push_back(check.name);
  EXPECT_TRUE(outcome.caught()) << outcome.formulations() << " of " << outcome.formulations_wanted << ", by "
                                << testing::PrintToString(outcome.caught_by);
}

INSTANTIATE_TEST_SUITE_P(
    Telescopes, UpsDefect,
    testing::Values("UPS: psi from -u", "UPS: d from the rod's inner end", "UPS: rod's inner end at d",
                    "UPS: cylinder slides along with its rod", "UPS: psi's rate with the stroke for d",
                    "Coriolis terms of what slides once for twice", "(48) without the rates of the other joints",
                    "cylinder for rod and rod for cylinder", "stroke of a tenth of the cylinder", "sign of all torques",
                    "no Coulomb friction on d", "d counted from the other end of the rod"),
    [](const auto& defect) { return asTestName(defect.param); });

}  // namespace
}  // namespace ursula
