// Tests of the checks themselves: defects are caught, wrong parameters are seen, and random machines pass.

#include "parts/prove/prove.h"
#include "base/start_threads.h"
#include "model/instants.h"
#include "report/files/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <set>

#include "parts/prove/defects.h"
#include "parts/random/random_scenario.h"
#include "tests/support/whole.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/evidence/reference.h"

namespace ursula {
namespace {

const Scenario& provingGround() {
  static const Scenario scenario = scenarioOf("proving-ground", 31);  // for speed
  return scenario;
}

/// Counts where the defect is: in the solver, in the common input, or in an experiment.
int placesOf(const Defect& defect) {
  const bool in_experiment = !defect.subject && !defect.scenario;
  return (defect.subject ? 1 : 0) + (defect.scenario ? 1 : 0) + (in_experiment ? 1 : 0);
}

/// Uses one reference for all defects that do not change the scenario.
std::vector<Check> checksWith(const Defect& defect, bool at_samples_alone = false) {
  ValidationOptions options;
  options.budget = false;
  options.quick = at_samples_alone;
  options.fault = std::make_shared<const InjectedFault>(defect.fault);
  if (defect.scenario) return validate(defect.scenario(provingGround()), options).checks;
  options.reference = referenceOf("proving-ground", 31);
  return validateMade(provingGround(), defect.subject ? defect.subject : solverOf, options).checks;
}

TEST(Defects, areManyAndOfEveryGroup) {
  std::set<std::string> names;
  std::map<std::string, int> groups;
  const std::vector<Defect> defects = allDefects(*provingGround().manipulator);
  for (const Defect& defect : defects) {
    names.insert(defect.name);
    ++groups[defect.group];
    EXPECT_EQ(placesOf(defect), 1) << defect.name << " is put into more than one place, or into none";
  }
  EXPECT_GE(defects.size(), 150u);
  EXPECT_EQ(names.size(), defects.size()) << "a name is there twice";
  for (const char* group :
       {"formula", "term", "parameter", "index", "frame", "friction", "motion", "torque", "branch", "kinematics",
        "direct", "hidden", "shared motion", "shared load", "experiment", "leg", "one frame", "fast", "control"})
    EXPECT_GE(groups[group], 5) << group;
  EXPECT_GE(groups["complement"], 2);
  EXPECT_EQ(groups.size(), 20u);
}

/// Defects that only one formulation can see belong to these groups; all others need two.
TEST(Defects, areHeldToTwoEnginesButWhereOneAloneCanSee) {
  const std::set<std::string> alone = {"branch",      "kinematics", "direct",    "hidden",     "shared motion",
                                       "shared load", "experiment", "one frame", "complement", "fast"};
  for (const Defect& defect : allDefects(*provingGround().manipulator))
    if (!defect.control) {
      EXPECT_EQ(defect.formulations_wanted, alone.count(defect.group) == 1 ? 1 : 2) << defect.name;
    }
}

struct Caught {
  const char *group, *name;
  const char* by;      ///< a check that must fail
  const char* not_by;  ///< a check that must not fail
};

class OneDefect : public testing::TestWithParam<Caught> {};

TEST_P(OneDefect, isCaughtByWhatMustSeeIt) {
  const std::vector<Defect> defects = allDefects(*provingGround().manipulator);
  const auto found =
      std::find_if(defects.begin(), defects.end(), [](const Defect& defect) { return defect.name == GetParam().name; });
  ASSERT_NE(found, defects.end());
  EXPECT_EQ(found->group, GetParam().group);
  const std::vector<Check> checks = checksWith(*found);
  EXPECT_EQ(overall(checks), Verdict::fail);
  EXPECT_EQ(verdictOf(checks, GetParam().by), "fail");
  EXPECT_EQ(verdictOf(checks, GetParam().not_by), "pass");
}

INSTANTIATE_TEST_SUITE_P(
    Groups, OneDefect,
    testing::Values(
        Caught{"formula", "(15a) as printed", "kinematics.joint_rates", "kinematics.joint_angles"},
        Caught{"term", "(43): no Coriolis terms", "kinematics.accelerations", "kinematics.twists"},
        Caught{"parameter", "manipulator.leg.2.proximal.mass off by 1e-06", "torque.pointwise", "kinematics.positions"},
        Caught{"index", "smoothing speed of leg 4 for leg 5", "torque.mujoco", "kinematics.accelerations"},
        Caught{"frame", "tensor of the platform not turned", "torque.maximal", "kinematics.accelerations"},
        Caught{"friction", "atan for tanh", "direct.pointwise", "kinematics.accelerations"},
        Caught{"motion", "omega in M for omega in B", "kinematics.joint_rates", "kinematics.joint_angles"},
        Caught{"torque", "torque 1 off by 1e-9 of itself", "torque.maximal", "kinematics.jacobian"},
        Caught{"branch", "pulse between samples, leg 3", "torque.between", "torque.pointwise"},
        Caught{"kinematics", "T_dot off by 1e-6 of itself, but for the rates of the motion",
               "kinematics.jacobian_difference", "kinematics.jacobian_rate"},
        Caught{"direct", "direct dynamics at the commanded pose", "direct.off_path", "direct.pointwise"},
        Caught{"hidden", "wrong where leg 1 has its knee the other way", "invariance.labels", "invariance.mass"},
        Caught{"shared motion", "omega off by 1e-9 of itself", "motion.twist", "motion.pose"},
        Caught{"shared load", "load's slopes limited for f_y + 1e-6 f_z, not for f_y", "motion.load",
               "torque.pointwise"},
        Caught{"leg", "leg 1 alone: distal mass", "torque.pointwise", "kinematics.positions"},
        Caught{"one frame", "platform's mass, where gravity points up", "invariance.rotation", "torque.pointwise"},
        Caught{"complement", "(33): D with one row twice", "complement.rank", "complement.orthogonality"},
        Caught{"fast", "fast, portable: batch's effort of motor 1 times 1 + 1e-7", "fast.inverse_batch",
               "fast.inverse"},
        Caught{"experiment", "sign of f_B, leg 4", "reactions.pointwise", "torque.pointwise"}),
    [](const auto& caught) { return asTestName(caught.param.group); });

/// Every third defect that only controls its mechanism, or each of them where all are asked for.
std::vector<Defect> controls() {
  const std::size_t step = wholeAsked() ? 1 : 3;
  std::vector<Defect> all, some;
  for (const Defect& defect : allDefects(*provingGround().manipulator))
    if (defect.control) all.push_back(defect);
  EXPECT_GE(all.size(), 15U);
  for (std::size_t k = 0; k < all.size(); k += step) some.push_back(all[k]);
  return some;
}

/// A defect's mechanism changes nothing by itself. Otherwise its defects would be caught for another reason.
TEST(NoDefect, isCaughtByNoneInAnyMechanism) {
  for (const Defect& control : controls()) EXPECT_EQ(others(checksWith(control), Verdict::pass), "") << control.name;
}

/// The control notices an error of the mechanism itself, already at the samples.
TEST(NoDefect, noticesAnErrorOfTheMechanism) {
  int noticed = 0;
  for (const Defect& defect : controls()) {
    if (!defect.subject) continue;
    Defect off = defect;
    off.subject = [make = defect.subject](const Scenario& scenario) { return scaledTorques(make(scenario), 1.001); };
    EXPECT_EQ(overall(checksWith(off, true)), Verdict::fail) << defect.name;
    ++noticed;
  }
  EXPECT_GE(noticed, 3);
}

const std::vector<Check>& checksWithNone() {
  static const std::vector<Check> once = checksWith({"none", ""});
  return once;
}

TEST(NoDefect, isCaughtByNone) { EXPECT_EQ(others(checksWithNone(), Verdict::pass), ""); }

/// Absent things cannot be falsified, and the list does not claim it.
TEST(NoDefect, changesNothing) {
  const Defect none{"none", "", nullptr, [](const Scenario& s) { return s; }};
  const std::vector<Check>&alone = checksWithNone(), afresh = checksWith(none);
  ASSERT_EQ(alone.size(), afresh.size());
  EXPECT_GT(judgedCount(alone), 30);
  for (std::size_t k = 0; k < alone.size(); ++k)
    if (alone[k].verdict != Verdict::not_applicable)
      EXPECT_EQ(alone[k].value, afresh[k].value) << alone[k].name;
    else
      EXPECT_EQ(afresh[k].verdict, Verdict::not_applicable) << alone[k].name;
}

TEST(DefectOutcome, countsEnginesAndNotChecks) {
  DefectOutcome outcome;
  outcome.caught_by = {"torque.pointwise", "torque.twin"};
  EXPECT_EQ(outcome.formulations(), 1);
  EXPECT_FALSE(outcome.caught());
  outcome.caught_by.emplace_back("torque.maximal");
  EXPECT_TRUE(outcome.caught());
  EXPECT_TRUE((DefectOutcome{"", "", {"motion.pose"}, 1, false, ""}.caught()));
  EXPECT_FALSE((DefectOutcome{"", "", {}, 1, false, ""}.caught()));
  EXPECT_TRUE((DefectOutcome{"", "", {}, 2, true, "no such machine"}.caught()));
}

TEST(Parameters, areThoseOfPlatformGravityAndSixLegs) {
  std::set<std::string> names;
  std::map<std::string, int> groups;
  for (const Parameter& parameter : allParameters(*provingGround().manipulator)) {
    names.insert(parameter.path);
    ++groups[name(parameter.group())];
  }
  EXPECT_EQ(names.size(), 13u + 6 * 33);
  EXPECT_EQ(groups, (std::map<std::string, int>{{"gravity", 3},
                                                {"mass", 1 + 12},
                                                {"center", 3 + 12},
                                                {"inertia", 6 + 72},
                                                {"length", 12},
                                                {"point", 36},
                                                {"axis", 12},
                                                {"friction", 42}}));
}

const std::vector<Sensitivity>& sensitivitiesThere() {
  static const std::vector<Sensitivity> once = proveSensitivities(provingGround());
  return once;
}

TEST(Sensitivities, everyParameterShowsOnTheProvingGround) {
  const std::vector<Sensitivity>& sensitivities = sensitivitiesThere();
  EXPECT_EQ(sensitivities.size(), allParameters(*provingGround().manipulator).size());
  const std::set<std::string> sharp = {"mass", "center", "length", "point", "axis", "gravity"};
  for (const Sensitivity& each : sensitivities) {
    EXPECT_LE(each.smallest_caught, sharp.count(each.group) == 1 ? 1e-8 : 1e-5) << each.parameter;
    EXPECT_LE(each.torque_change, 1e-11) << each.parameter;
    EXPECT_GT(each.smallest_caught, 1e-16) << each.parameter << ": rounding is taken for an error";
  }
}

/// The verdict of torque.pointwise on the solver with one wrong parameter.
std::string verdictWith(const Parameter& parameter, double relative) {
  Subject subject = disturbedSubject(provingGround(), parameter, relative);
  subject.kinematics = nullptr;
  const auto times = equallySpaced(provingGround().trajectory->duration(), 31);
  return verdictOf(judgePointwise(runPointwise(provingGround(), subject, times), false), "torque.pointwise");
}

TEST(Sensitivities, areTheThresholdOfTheCheckItself) {
  const std::vector<Parameter> parameters = allParameters(*provingGround().manipulator);
  const std::vector<Sensitivity>& sensitivities = sensitivitiesThere();
  std::set<std::string> groups;
  for (std::size_t k = 0; k < parameters.size(); k += 7) {
    groups.insert(name(parameters[k].group()));
    ASSERT_EQ(sensitivities[k].parameter, parameters[k].path);
    EXPECT_EQ(verdictWith(parameters[k], sensitivities[k].smallest_caught), "fail") << parameters[k].path;
    EXPECT_EQ(verdictWith(parameters[k], 0.9 * sensitivities[k].smallest_caught), "pass") << parameters[k].path;
  }
  EXPECT_EQ(groups.size(), 8u) << "a group is left out";
}

TEST(Sensitivities, whatIsNotThereDoesNotShow) {
  for (const Sensitivity& each : proveSensitivities(scenarioOf("paper-helix"))) {
    if (each.group != "friction") continue;  // the helix has none, and a share of zero is zero
    EXPECT_TRUE(std::isinf(each.smallest_caught)) << each.parameter;
    EXPECT_EQ(each.torque_change, 0) << each.parameter;
  }
}

TEST(ProveRandom, raisesNoAlarmForAnyNumberOfJobs) {
  std::atomic<int> told{0};
  const RandomOutcomes one = proveRandom(1, 2, 1, [&](int) { ++told; });
  EXPECT_EQ(told, 2);
  EXPECT_EQ(one.runs, 2);
  EXPECT_EQ(one.passed, 2);
  EXPECT_TRUE(one.failed.empty() && one.inconclusive.empty());
  for (const char* check : {"torque.pointwise", "torque.maximal", "integration.ladder", "reactions.pointwise"}) {
    ASSERT_EQ(one.largest_share.count(check), 1u) << check;
    EXPECT_GT(one.largest_share.at(check), 0) << check;
    EXPECT_LT(one.largest_share.at(check), 1) << check;
  }
  double share = 0;
  for (std::uint64_t seed : {1, 2}) {
    Scenario scenario = randomScenario(seed);
    scenario.simulation.samples = 101;
    const Check torque = *findCheck(validate(scenario).checks, "torque.pointwise");
    share = std::max(share, torque.value / torque.limit);
  }
  EXPECT_EQ(one.largest_share.at("torque.pointwise"), share);
  const RandomOutcomes two = proveRandom(1, 2, 2, [](int) {});
  EXPECT_EQ(two.passed, one.passed);
  EXPECT_EQ(two.largest_share, one.largest_share) << "to the last bit";
}

TEST(ProveRandom, namesTheWorstCheckAndNotTheFirst) {
  const Check passed = judged("torque.twin", 0.9, 1, "N m", "", "leg 1");
  const Check failed = judged("replay.position", 2, 1, "m", "", "late"),
              worst = judged("torque.pointwise", 9, 3, "N m", "", "leg 2");
  EXPECT_EQ(worstText(3, {passed, failed, worst}), "seed 3: torque.pointwise 9 of 3 N m: leg 2");
  EXPECT_EQ(worstText(3, {passed, failed}), "seed 3: replay.position 2 of 1 m: late");
  EXPECT_EQ(worstText(3, {}), "");
}

TEST(EngineOf, countsWhatAChecksVerdictRestsOn) {
  EXPECT_EQ(engineOf("torque.pointwise"), "Simbody");
  EXPECT_EQ(engineOf("replay.position"), "Simbody");
  EXPECT_EQ(engineOf("torque.twin"), "Simbody") << "the same engine and the same builder";
  EXPECT_EQ(engineOf("torque.maximal"), "maximal coordinates");
  EXPECT_EQ(engineOf("torque.mujoco"), "MuJoCo");
  EXPECT_EQ(engineOf("torque.between"), "torque.between");
  EXPECT_EQ(engineOf("motion.pose"), "motion.pose");
  EXPECT_EQ(engineOf("direct.off_path"), "Simbody");
  EXPECT_EQ(engineOf("invariance.labels"), "invariance.labels");
  EXPECT_EQ(engineOf("kinematics.jacobian_difference"), "kinematics.jacobian_difference");
}

TEST(InParallel, doesEachTaskOnceAndThrowsWhatATaskThrew) {
  for (int jobs : {1, 2, 5}) {
    std::vector<std::atomic<int>> done(20);
    inParallel(jobs, 20, [&](int k) { ++done[static_cast<std::size_t>(k)]; });
    EXPECT_THAT(std::vector<int>(done.begin(), done.end()), testing::Each(1)) << jobs;
    EXPECT_THROW(inParallel(jobs, 20, [](int k) { k == 7 ? throw std::domain_error("seven") : void(); }),
                 std::domain_error);
  }
}

}  // namespace
}  // namespace ursula
