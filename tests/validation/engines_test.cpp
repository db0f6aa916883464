// Four formulations of the torques, and a fifth in builds with MuJoCo. Right ones agree, every other sees a wrong one,
// and the wrong one is named.

#include "validation/samples/engines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/instants.h"
#include "nocsolver/errors.h"
#include "parts/engines/mujoco/mujoco_loop.h"
#include "report/files/report.h"
#include "report/text/result_facts.h"
#include "report/text/terminal.h"
#include "simbody/simbody_loop.h"
#include "tests/support/matchers.h"
#include "tests/support/numbers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"
#include "validation/evidence/injected_fault.h"
#include "validation/findings/findings.h"
#include "validation/samples/simbody_samples.h"
#include "validation/validate.h"

namespace ursula {
namespace {

constexpr int instants = 11;
constexpr std::size_t twin = 0, maximal = 1, mujoco = 2;  ///< in the table

std::string oddWords(const std::vector<EngineSample>& engines) { return inWords(oddOneOut(engines)); }

/// These four together have friction, a load and Coulomb friction.
const std::vector<std::string> machines = {"paper-helix", "random-2", "random-5", "proving-ground"};
const auto machineName = [](const auto& name) { return asTestName(name.param); };

class Engines : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
  std::vector<PointwiseSample> samples_ = rightSamples(scenario_, instants);
  RoundingProfile profile_{scenario_, instants};
  double largest_ = largestTorque(samples_);
};

TEST_P(Engines, ofExactTorquesAgree) {
  const std::vector<EngineSample> engines = runEngines(scenario_, samples_, profile_);
  const std::vector<Check> checks = judgeEngines(engines);
  EXPECT_EQ(verdictOf(checks, "torque.twin"), "pass");
  EXPECT_EQ(verdictOf(checks, "torque.maximal"), "pass");
  EXPECT_EQ(verdictOf(checks, "torque.mujoco"), mujocoAvailable() ? "pass" : "(none)");
  for (const Check& check : checks) {
    EXPECT_GT(check.value, 0) << check.name << ": a formulation compared with itself";
    EXPECT_LT(check.limit, 1e-10 * largest_) << check.name << ": the limit says little";
  }
  for (const EngineSample& engine : engines) {
    EXPECT_TRUE(engine.further[twin] && engine.further[maximal]);
    EXPECT_EQ(engine.further[mujoco].has_value(), mujocoAvailable());
    for (std::size_t k = 0; k < furtherEngines().size(); ++k) {
      EXPECT_NE(engine.further[k], engine.simbody) << "no two formulations round alike";
      for (std::size_t j = 0; j < k; ++j) EXPECT_NE(engine.further[k], engine.further[j]);
    }
  }
  EXPECT_EQ(oddWords(engines), mujocoAvailable() ? "none: 5 formulations agree" : "none: 4 formulations agree");
}

TEST_P(Engines, seeATorqueThatIsOffByABillionthOfTheLargest) {
  const Subject right = solverOf(scenario_);
  Subject wrong = right;
  wrong.torques = [&](const Motion<double>& motion) {
    return Vector6d(right.torques(motion) + 1e-9 * largest_ * Vector6d::Unit(4));
  };
  const auto times = equallySpaced(scenario_.trajectory->duration(), instants);
  const std::vector<EngineSample> engines = runEngines(scenario_, runPointwise(scenario_, wrong, times), profile_);
  for (const Check& check : judgeEngines(engines)) {
    EXPECT_EQ(check.verdict, Verdict::fail) << check.name;
    EXPECT_NEAR(check.value, 1e-9 * largest_, check.limit) << check.name;
  }
  EXPECT_EQ(oddWords(engines), "the torques under test");
}

INSTANTIATE_TEST_SUITE_P(Machines, Engines, testing::ValuesIn(machines), machineName);

void setLimits(EngineSample& engine, double limit) {
  engine.limit = limit;
  engine.limits.fill(limit);
}

/// Made-up formulations at 1000 N·m with a limit of 1e-9 N·m, each with a rounding of its own.
std::vector<EngineSample> agreeing() {
  std::vector<EngineSample> engines(5);
  for (std::size_t k = 0; k < engines.size(); ++k) {
    EngineSample& engine = engines[k];
    engine.t = 0.5 * static_cast<double>(k);
    setLimits(engine, 1e-9);
    engine.subject = Vector6d::Constant(1000);
    engine.simbody = engine.subject + Vector6d::Constant(1e-10);
    engine.further[twin] = engine.subject - Vector6d::Constant(1e-10);
    engine.further[maximal] = engine.subject + 2e-10 * Vector6d::Unit(5);
    engine.further[mujoco] = engine.subject - 2e-10 * Vector6d::Unit(5);
  }
  return engines;
}

/// The samples of a build without MuJoCo.
std::vector<EngineSample> withoutMujoco(std::vector<EngineSample> engines) {
  for (EngineSample& engine : engines) engine.further[mujoco].reset();
  return engines;
}

struct Faulty {
  const char* name;
  Vector6d& (*torques)(EngineSample&);
  const char *twin, *maximal, *mujoco;  ///< verdicts if this formulation is wrong
};

const std::vector<Faulty> five_formulations = {
    {"the torques under test", [](EngineSample& engine) -> Vector6d& { return engine.subject; }, "fail", "fail",
     "fail"},
    {"Simbody, free platform", [](EngineSample& engine) -> Vector6d& { return engine.simbody; }, "pass", "pass",
     "pass"},
    {"Simbody, tree through leg 1", [](EngineSample& engine) -> Vector6d& { return *engine.further[twin]; }, "fail",
     "pass", "pass"},
    {"maximal coordinates", [](EngineSample& engine) -> Vector6d& { return *engine.further[maximal]; }, "pass", "fail",
     "pass"},
    {"MuJoCo", [](EngineSample& engine) -> Vector6d& { return *engine.further[mujoco]; }, "pass", "pass", "fail"}};

TEST(OddOneOut, isNoneWhereAllAgree) {
  EXPECT_EQ(oddWords(agreeing()), "none: 5 formulations agree");
  EXPECT_EQ(oddWords(withoutMujoco(agreeing())), "none: 4 formulations agree");
}

TEST(OddOneOut, isUnknownWhereNothingWasCompared) { EXPECT_THAT(oddWords({}), HasSubstr("no instant")); }

TEST(OddOneOut, isNamedWhereOneLegOfOneEngineIsWrongAtOneInstant) {
  for (const Faulty& engine : five_formulations)
    for (int leg = 0; leg < leg_count; ++leg) {
      std::vector<EngineSample> engines = agreeing();
      engine.torques(engines[3])(leg) += 1e-8;
      EXPECT_EQ(oddWords(engines), engine.name) << "leg " << leg + 1;
      EXPECT_EQ(oddWords(withoutMujoco(engines)),
                engine.name == std::string("MuJoCo") ? "none: 4 formulations agree" : engine.name);
    }
}

TEST(OddOneOut, isNamedWhereOneLegOfItIsNoNumber) {
  for (const Faulty& engine : five_formulations)
    for (int leg = 0; leg < leg_count; ++leg) {
      std::vector<EngineSample> engines = agreeing();
      engine.torques(engines[3])(leg) = nan;
      EXPECT_EQ(oddWords(engines), engine.name) << "leg " << leg + 1;
    }
}

TEST(OddOneOut, isNobodyWhereTwoAreWrong) {
  for (const double other : {1e-8, -1e-8}) {  // all alike, and each in its own way
    std::vector<EngineSample> engines = agreeing();
    (*engines[2].further[maximal])(1) += 1e-8;
    engines[2].subject(1) += other;
    EXPECT_THAT(oddWords(engines), HasSubstr("not one alone"));
  }
}

TEST(OddOneOut, isNobodyWhereEachIsWrongAtAnInstantOfItsOwn) {
  std::vector<EngineSample> engines = agreeing();
  (*engines[1].further[maximal])(0) += 1e-8;
  (*engines[4].further[mujoco])(0) += 1e-8;
  EXPECT_THAT(oddWords(engines), HasSubstr("not one alone"));
}

/// An error of Simbody as a whole is no error of the efforts.
TEST(OddOneOut, isAnEngineWhoseTopologiesAreBothWrong) {
  for (const std::size_t instant : {1U, 4U}) {  // alike, and each at an instant of its own
    std::vector<EngineSample> engines = agreeing();
    (*engines[1].further[twin])(0) += 1e-8;
    engines[instant].simbody(0) += 1e-8;
    for (const auto& all : {engines, withoutMujoco(engines)}) {
      const OddOne odd = oddOneOut(all);
      EXPECT_EQ(odd.engine(), "Simbody");
      EXPECT_FALSE(odd.agree);
      EXPECT_EQ(inWords(odd), "Simbody, both topologies");
    }
    for (EngineSample& engine : engines) engine.subject(0) += 1e-7;
    EXPECT_THAT(oddWords(engines), HasSubstr("not one alone")) << "two are wrong";
  }
}

/// The finding and the checks compare with the same limits.
TEST(OddOneOut, isNamedFromOneLimitOn) {
  for (const double limits : {0.5, 1.5, 2.0, 4.0, 6.0}) {
    std::vector<EngineSample> engines = agreeing();
    engines[2].subject(3) += limits * 1e-9;
    EXPECT_EQ(others(judgeEngines(engines), limits < 1 ? Verdict::pass : Verdict::fail), "") << limits;
    EXPECT_EQ(oddWords(engines), limits < 1 ? "none: 5 formulations agree" : "the torques under test") << limits;
  }
}

TEST(OddOneOut, isEitherOfTwoWithWhichAllOthersAgree) {
  std::vector<EngineSample> engines = agreeing();
  engines[2].limits[maximal] = 0.9e-10;
  const OddOne odd = oddOneOut(engines);
  EXPECT_EQ(odd.engine(), "");
  EXPECT_EQ(inWords(odd), "either the torques under test or maximal coordinates: the others agree with both");
}

TEST(JudgeEngines, failsWhereTheSubjectAndThatEngineDiffer) {
  for (const Faulty& engine : five_formulations) {
    std::vector<EngineSample> engines = agreeing();
    engine.torques(engines[3])(2) -= 1e-8;
    const std::vector<Check> checks = judgeEngines(engines);
    EXPECT_EQ(verdictOf(checks, "torque.twin"), engine.twin) << engine.name;
    EXPECT_EQ(verdictOf(checks, "torque.maximal"), engine.maximal) << engine.name;
    EXPECT_EQ(verdictOf(checks, "torque.mujoco"), engine.mujoco) << engine.name;
    const std::vector<Check> fewer = judgeEngines(withoutMujoco(engines));
    EXPECT_EQ(verdictOf(fewer, "torque.maximal"), engine.maximal) << engine.name;
    EXPECT_EQ(verdictOf(fewer, "torque.mujoco"), "(none)") << engine.name;
  }
}

TEST(JudgeEngines, judgesEachInstantByItsOwnLimit) {
  std::vector<EngineSample> engines = agreeing();
  (*engines[4].further[maximal])(0) += 1e-7, setLimits(engines[4], 1e-6);  // larger, but allowed there
  EXPECT_EQ(verdictOf(judgeEngines(engines), "torque.maximal"), "pass");
  (*engines[1].further[maximal])(0) += 1e-8;
  const Check check = *findCheck(judgeEngines(engines), "torque.maximal");
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_THAT(check.why, HasSubstr("t = 0.5 s"));
}

/// Each formulation rounds differently, so each has its own limit.
TEST(JudgeEngines, judgesEachEngineByItsOwnLimit) {
  const std::pair<const char*, std::size_t> limits[] = {
      {"torque.twin", twin}, {"torque.maximal", maximal}, {"torque.mujoco", mujoco}};
  for (const auto& [tight, limit] : limits) {
    std::vector<EngineSample> engines = agreeing();
    engines[2].limits[limit] = 0.9e-10;
    for (const auto& [check, other] : limits)
      EXPECT_EQ(verdictOf(judgeEngines(engines), check), check == tight ? "fail" : "pass") << tight;
  }
}

TEST(JudgeEngines, keepsTheLargestDifferenceBesideTheOneNearestToItsLimit) {
  std::vector<EngineSample> engines = agreeing();
  (*engines[4].further[maximal])(3) += 1e-7, setLimits(engines[4], 1e-5);
  const Check check = *findCheck(judgeEngines(engines), "torque.maximal");
  EXPECT_EQ(check.limit, 1e-9);
  EXPECT_NEAR(check.largest.value, 1e-7, 1e-9);
  EXPECT_EQ(check.largest.t, 2);
  EXPECT_EQ(check.largest.where, "leg 4");
}

TEST(JudgeEngines, noNumberIsNoAgreement) {
  for (int leg = 0; leg < leg_count; ++leg) {
    std::vector<EngineSample> engines = agreeing();
    (*engines[1].further[twin])(leg) = nan;
    EXPECT_EQ(verdictOf(judgeEngines(engines), "torque.twin"), "fail") << "leg " << leg + 1;
    EXPECT_EQ(verdictOf(judgeEngines(engines), "torque.maximal"), "pass") << "leg " << leg + 1;
  }
  std::vector<EngineSample> engines = agreeing();
  setLimits(engines[1], nan);
  EXPECT_EQ(others(judgeEngines(engines), Verdict::fail), "");
}

TEST(JudgeEngines, noInstantIsNoAgreement) {
  const std::vector<Check> checks = judgeEngines({});
  EXPECT_EQ(verdictOf(checks, "torque.twin"), "fail");
  EXPECT_EQ(verdictOf(checks, "torque.maximal"), "fail");
  EXPECT_EQ(verdictOf(checks, "torque.mujoco"), mujocoAvailable() ? "fail" : "(none)");
}

/// Simbody as a whole with a platform that is heavier, in both topologies.
InjectedFault heavierInSimbody(double factor) {
  const auto heavier = [factor](ManipulatorParameters& parameters) { parameters.platform.mass *= factor; };
  InjectedFault fault;
  fault.formulations.simbody.machine = heavier;
  fault.formulations.further[twin].machine = heavier;
  return fault;
}

class WrongSimbody : public testing::Test {
 protected:
  ValidationResult judged(double factor, const Subject* subject = nullptr) const {
    ValidationOptions quick{false, false, false};
    quick.reference = referenceOf("paper-helix", 31);
    quick.fault = std::make_shared<const InjectedFault>(heavierInSimbody(factor));
    return subject == nullptr ? validate(scenario_, quick) : validate(scenario_, *subject, quick);
  }
  Scenario scenario_ = scenarioOf("paper-helix", 31);
};

TEST_F(WrongSimbody, isNamedAndTheEffortsAreNotBlamed) {
  Subject users = torquesAlone(scenario_);
  users.formulation = Formulation::external;
  for (const Subject* subject : {static_cast<const Subject*>(nullptr), static_cast<const Subject*>(&users)}) {
    const ValidationResult result = judged(1 + 1e-6, subject);
    EXPECT_EQ(result.verdict, Verdict::fail);
    EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "fail");
    EXPECT_EQ(verdictOf(result.checks, "torque.twin"), "fail");
    EXPECT_EQ(result.odd_one.engine(), "Simbody");
    EXPECT_TRUE(onlyOddEngineFails(result));
    EXPECT_EQ(result.cause_words.cause, "") << "nothing is wrong with the efforts";
    ASSERT_TRUE(result.deviation);
    EXPECT_LT(result.deviation->relative(), 1e-13);
    EXPECT_EQ(result.deviation->without, "Simbody");
    EXPECT_GT(result.deviation->smallestRelative(), 1e-9) << "a tolerance has to cover Simbody's error";
    EXPECT_THAT(deviationSentence(result), StartsWith("Against all formulations but Simbody's: Right to"));
    EXPECT_THAT(report::sentence(result), StartsWith("The odd one out is Simbody, both topologies: the "));
    EXPECT_THAT(report::validationText(result, false), Not(HasSubstr("are wrong")));
  }
}

TEST_F(WrongSimbody, doesNotExcuseWrongEfforts) {
  const Subject wrong = scaledTorques(torquesAlone(scenario_), 1 + 1e-5);
  const ValidationResult result = judged(1 + 1e-6, &wrong);
  EXPECT_EQ(result.odd_one.engine(), "");
  EXPECT_FALSE(onlyOddEngineFails(result));
  EXPECT_FALSE(onlyOddEngineFails(judged(1))) << "nothing fails";
}

class ReactionCheck : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
  std::vector<PointwiseSample> samples_ = rightSamples(scenario_, instants);
  RoundingProfile profile_{scenario_, instants};
  Subject solver_ = nocSubject(*scenario_.manipulator, scenario_.load);

  Check judge(const std::vector<PointwiseSample>& samples) const {
    return judgeReactions(runReactions(scenario_, solver_, samples), samples, profile_);
  }
};

TEST_P(ReactionCheck, passesForTheSolver) {
  TimeSeries series;
  const std::vector<ReactionSample> reactions = runReactions(scenario_, solver_, samples_);
  addReactionColumns(*scenario_.manipulator, reactions, {}, series);
  const Check check = judgeReactions(reactions, samples_, profile_);
  EXPECT_EQ(check.verdict, Verdict::pass) << check.why;
  EXPECT_GT(check.value, 0);
  const double weight = scenario_.manipulator->platform().mass * scenario_.manipulator->gravity().norm();
  EXPECT_LT(check.limit, 1e-9 * weight) << "the limit says little";
  EXPECT_EQ(series.names.size(), 6u * 5 * 3);  // legs, joints' forces and moments, axes
  EXPECT_EQ(series.rows(), samples_.size());
}

TEST_P(ReactionCheck, holdsTheLimitThatTheSamplesGive) {
  for (PointwiseSample& sample : samples_) {
    sample.conditioning.torque_scale *= 1e-6;
    sample.conditioning.force_scale *= 1e-6;
  }
  EXPECT_EQ(judge(samples_).verdict, Verdict::fail);
}

TEST_P(ReactionCheck, failsWhereAnyMotionIsNoNumber) {
  for (PointwiseSample& sample : samples_) {
    const double right = sample.motion.omega_dot.x();
    sample.motion.omega_dot.x() = nan;
    EXPECT_EQ(judge(samples_).verdict, Verdict::fail) << sample.motion.t;
    sample.motion.omega_dot.x() = right;
  }
}

TEST_P(ReactionCheck, noInstantIsNoAgreement) { EXPECT_EQ(judge({}).verdict, Verdict::fail); }

TEST_P(ReactionCheck, refusesAMotionThatTheMachineCannotMake) {
  samples_.back().motion.p.z() += 10;
  EXPECT_THROW(judge(samples_), PoseError);
}

INSTANTIATE_TEST_SUITE_P(Machines, ReactionCheck, testing::Values("paper-helix", "random-5", "proving-ground"),
                         machineName);

}  // namespace
}  // namespace ursula
