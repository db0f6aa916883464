// Four roads to the torques, and a fifth where MuJoCo is built in: exact ones agree, a wrong one is seen by every
// other, and the one that is wrong is named.

#include "validation/samples/roads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/instants.h"
#include "model/loops/mujoco/mujoco_loop.h"
#include "nocsolver/errors.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/reaction_check.h"
#include "validation/checks/road_checks.h"
#include "validation/findings/timeseries.h"
#include "validation/samples/reaction_samples.h"

namespace ursula {
namespace {

using testing::HasSubstr;

constexpr int instants = 11;
constexpr std::size_t twin = 0, maximal = 1, mujoco = 2;  ///< in the table
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Friction, a load and Coulomb's law are in these four between them.
const std::vector<std::string> machines = {"paper-helix", "random-2", "random-5", "proving-ground"};
const auto machineName = [](const auto& name) { return asTestName(name.param); };

class Roads : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
  std::vector<PointwiseSample> samples_ = rightSamples(scenario_, instants);
  RoundingProfile profile_{scenario_, instants};
  double largest_ = largestTorque(samples_);
};

TEST_P(Roads, ofExactTorquesAgree) {
  const std::vector<RoadSample> roads = runRoads(scenario_, samples_, profile_);
  const std::vector<Check> checks = judgeRoads(roads);
  EXPECT_EQ(verdictOf(checks, "torque.twin"), "pass");
  EXPECT_EQ(verdictOf(checks, "torque.maximal"), "pass");
  EXPECT_EQ(verdictOf(checks, "torque.mujoco"), mujocoAvailable() ? "pass" : "(none)");
  for (const Check& check : checks) {
    EXPECT_GT(check.value, 0) << check.name << ": a road compared with itself";
    EXPECT_LT(check.limit, 1e-10 * largest_) << check.name << ": the limit says little";
  }
  for (const RoadSample& road : roads) {
    EXPECT_TRUE(road.further[twin] && road.further[maximal]);
    EXPECT_EQ(road.further[mujoco].has_value(), mujocoAvailable());
    for (std::size_t k = 0; k < further_road_count; ++k) {
      EXPECT_NE(road.further[k], road.simbody) << "no two roads round alike";
      for (std::size_t j = 0; j < k; ++j) EXPECT_NE(road.further[k], road.further[j]);
    }
  }
  EXPECT_EQ(oddOneOut(roads), mujocoAvailable() ? "none: 5 roads agree" : "none: 4 roads agree");
}

TEST_P(Roads, seeATorqueThatIsOffByABillionthOfTheLargest) {
  const Subject right = solverOf(scenario_);
  Subject wrong = right;
  wrong.torques = [&](const Motion<double>& motion) {
    return Vector6d(right.torques(motion) + 1e-9 * largest_ * Vector6d::Unit(4));
  };
  const auto times = equallySpaced(scenario_.trajectory->duration(), instants);
  const std::vector<RoadSample> roads = runRoads(scenario_, runPointwise(scenario_, wrong, times), profile_);
  for (const Check& check : judgeRoads(roads)) {
    EXPECT_EQ(check.verdict, Verdict::fail) << check.name;
    EXPECT_NEAR(check.value, 1e-9 * largest_, check.limit) << check.name;
  }
  EXPECT_EQ(oddOneOut(roads), "the torques on trial");
}

INSTANTIATE_TEST_SUITE_P(Machines, Roads, testing::ValuesIn(machines), machineName);

void setLimits(RoadSample& road, double limit) {
  road.limit = limit;
  road.limits.fill(limit);
}

/// Roads made up: all at 1000 N·m within a limit of 1e-9 N·m, but for a rounding of each.
std::vector<RoadSample> agreeing() {
  std::vector<RoadSample> roads(5);
  for (std::size_t k = 0; k < roads.size(); ++k) {
    RoadSample& road = roads[k];
    road.t = 0.5 * static_cast<double>(k);
    setLimits(road, 1e-9);
    road.subject = Vector6d::Constant(1000);
    road.simbody = road.subject + Vector6d::Constant(1e-10);
    road.further[twin] = road.subject - Vector6d::Constant(1e-10);
    road.further[maximal] = road.subject + 2e-10 * Vector6d::Unit(5);
    road.further[mujoco] = road.subject - 2e-10 * Vector6d::Unit(5);
  }
  return roads;
}

/// As from a build without MuJoCo.
std::vector<RoadSample> withoutMujoco(std::vector<RoadSample> roads) {
  for (RoadSample& road : roads) road.further[mujoco].reset();
  return roads;
}

struct Spoilt {
  const char* name;
  Vector6d& (*torques)(RoadSample&);
  const char *twin, *maximal, *mujoco;  ///< verdicts where this road is wrong
};

const std::vector<Spoilt> five_roads = {
    {"the torques on trial", [](RoadSample& road) -> Vector6d& { return road.subject; }, "fail", "fail", "fail"},
    {"Simbody, free platform", [](RoadSample& road) -> Vector6d& { return road.simbody; }, "pass", "pass", "pass"},
    {"Simbody, tree through leg 1", [](RoadSample& road) -> Vector6d& { return *road.further[twin]; }, "fail", "pass",
     "pass"},
    {"maximal coordinates", [](RoadSample& road) -> Vector6d& { return *road.further[maximal]; }, "pass", "fail",
     "pass"},
    {"MuJoCo", [](RoadSample& road) -> Vector6d& { return *road.further[mujoco]; }, "pass", "pass", "fail"}};

TEST(OddOneOut, isNoneWhereAllAgree) {
  EXPECT_EQ(oddOneOut(agreeing()), "none: 5 roads agree");
  EXPECT_EQ(oddOneOut(withoutMujoco(agreeing())), "none: 4 roads agree");
}

TEST(OddOneOut, isUnknownWhereNothingWasCompared) { EXPECT_THAT(oddOneOut({}), HasSubstr("no instant")); }

TEST(OddOneOut, isNamedWhereOneLegOfOneRoadIsWrongAtOneInstant) {
  for (const Spoilt& road : five_roads)
    for (int leg = 0; leg < leg_count; ++leg) {
      std::vector<RoadSample> roads = agreeing();
      road.torques(roads[3])(leg) += 1e-8;
      EXPECT_EQ(oddOneOut(roads), road.name) << "leg " << leg + 1;
      EXPECT_EQ(oddOneOut(withoutMujoco(roads)),
                road.name == std::string("MuJoCo") ? "none: 4 roads agree" : road.name);
    }
}

TEST(OddOneOut, isNamedWhereOneLegOfItIsNoNumber) {
  for (const Spoilt& road : five_roads)
    for (int leg = 0; leg < leg_count; ++leg) {
      std::vector<RoadSample> roads = agreeing();
      road.torques(roads[3])(leg) = nan;
      EXPECT_EQ(oddOneOut(roads), road.name) << "leg " << leg + 1;
    }
}

TEST(OddOneOut, isNobodyWhereTwoAreWrong) {
  for (const double other : {1e-8, -1e-8}) {  // alike and each in its own way
    std::vector<RoadSample> roads = agreeing();
    (*roads[2].further[maximal])(1) += 1e-8;
    roads[2].subject(1) += other;
    EXPECT_THAT(oddOneOut(roads), HasSubstr("not one alone"));
  }
}

TEST(OddOneOut, isNobodyWhereEachIsWrongAtAnInstantOfItsOwn) {
  std::vector<RoadSample> roads = agreeing();
  (*roads[1].further[twin])(0) += 1e-8;
  roads[4].simbody(0) += 1e-8;
  EXPECT_THAT(oddOneOut(roads), HasSubstr("not one alone"));
}

TEST(JudgeRoads, failsWhereTheSubjectAndThatRoadDiffer) {
  for (const Spoilt& road : five_roads) {
    std::vector<RoadSample> roads = agreeing();
    road.torques(roads[3])(2) -= 1e-8;
    const std::vector<Check> checks = judgeRoads(roads);
    EXPECT_EQ(verdictOf(checks, "torque.twin"), road.twin) << road.name;
    EXPECT_EQ(verdictOf(checks, "torque.maximal"), road.maximal) << road.name;
    EXPECT_EQ(verdictOf(checks, "torque.mujoco"), road.mujoco) << road.name;
    const std::vector<Check> fewer = judgeRoads(withoutMujoco(roads));
    EXPECT_EQ(verdictOf(fewer, "torque.maximal"), road.maximal) << road.name;
    EXPECT_EQ(verdictOf(fewer, "torque.mujoco"), "(none)") << road.name;
  }
}

TEST(JudgeRoads, judgesEachInstantByItsOwnLimit) {
  std::vector<RoadSample> roads = agreeing();
  (*roads[4].further[maximal])(0) += 1e-7, setLimits(roads[4], 1e-6);  // larger, and allowed there
  EXPECT_EQ(verdictOf(judgeRoads(roads), "torque.maximal"), "pass");
  (*roads[1].further[maximal])(0) += 1e-8;
  const Check check = *findCheck(judgeRoads(roads), "torque.maximal");
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_THAT(check.why, HasSubstr("t = 0.5 s"));
}

/// Each road rounds in its own way, so each has a limit of its own.
TEST(JudgeRoads, judgesEachRoadByItsOwnLimit) {
  const std::pair<const char*, std::size_t> limits[] = {
      {"torque.twin", twin}, {"torque.maximal", maximal}, {"torque.mujoco", mujoco}};
  for (const auto& [tight, limit] : limits) {
    std::vector<RoadSample> roads = agreeing();
    roads[2].limits[limit] = 0.9e-10;
    for (const auto& [check, other] : limits)
      EXPECT_EQ(verdictOf(judgeRoads(roads), check), check == tight ? "fail" : "pass") << tight;
  }
}

TEST(JudgeRoads, keepsTheLargestDifferenceBesideTheOneNearestToItsLimit) {
  std::vector<RoadSample> roads = agreeing();
  (*roads[4].further[maximal])(3) += 1e-7, setLimits(roads[4], 1e-5);
  const Check check = *findCheck(judgeRoads(roads), "torque.maximal");
  EXPECT_EQ(check.limit, 1e-9);
  EXPECT_NEAR(check.largest.value, 1e-7, 1e-9);
  EXPECT_EQ(check.largest.t, 2);
  EXPECT_EQ(check.largest.where, "leg 4");
}

TEST(JudgeRoads, noNumberIsNoAgreement) {
  for (int leg = 0; leg < leg_count; ++leg) {
    std::vector<RoadSample> roads = agreeing();
    (*roads[1].further[twin])(leg) = nan;
    EXPECT_EQ(verdictOf(judgeRoads(roads), "torque.twin"), "fail") << "leg " << leg + 1;
    EXPECT_EQ(verdictOf(judgeRoads(roads), "torque.maximal"), "pass") << "leg " << leg + 1;
  }
  std::vector<RoadSample> roads = agreeing();
  setLimits(roads[1], nan);
  EXPECT_EQ(others(judgeRoads(roads), Verdict::fail), "");
}

TEST(JudgeRoads, noInstantIsNoAgreement) {
  const std::vector<Check> checks = judgeRoads({});
  EXPECT_EQ(verdictOf(checks, "torque.twin"), "fail");
  EXPECT_EQ(verdictOf(checks, "torque.maximal"), "fail");
  EXPECT_EQ(verdictOf(checks, "torque.mujoco"), mujocoAvailable() ? "fail" : "(none)");
}

class ReactionCheck : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam());
  std::vector<PointwiseSample> samples_ = rightSamples(scenario_, instants);
  RoundingProfile profile_{scenario_, instants};

  Check judge(const std::vector<PointwiseSample>& samples) const {
    return judgeReactions(runReactions(scenario_, samples), samples, profile_);
  }
};

TEST_P(ReactionCheck, passesForTheSolver) {
  TimeSeries series;
  const std::vector<ReactionSample> reactions = runReactions(scenario_, samples_);
  addReactionColumns(*scenario_.manipulator, reactions, series);
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
