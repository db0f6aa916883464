// Random machines of each kind of leg: their properties, and that they vary. Nothing is validated.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "nocsolver/solver.h"
#include "studies/random/random_scenario.h"

namespace ursula {
namespace {

constexpr int drawn = 60;

const std::vector<Scenario>& drawnOf(RandomKind kind) {
  static std::map<RandomKind, std::vector<Scenario>> all;
  std::vector<Scenario>& out = all[kind];
  for (std::uint64_t seed = out.size() + 1; seed <= drawn; ++seed) out.push_back(randomScenario(seed, kind));
  return out;
}

class RandomKinds : public testing::TestWithParam<RandomKind> {};

TEST_P(RandomKinds, areTheSeeds) {
  std::set<std::string> texts;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scenario &first = drawnOf(GetParam())[seed - 1], again = randomScenario(seed, GetParam());
    const Motion<double> one = first.trajectory->at(0), other = again.trajectory->at(0);
    EXPECT_EQ(first.text, again.text);
    EXPECT_EQ(first.name, std::string("random-") + nameOf(GetParam()) + "-" + std::to_string(seed));
    EXPECT_EQ(one.p, other.p);
    EXPECT_EQ(one.Q, other.Q);
    texts.insert(first.text);
  }
  EXPECT_EQ(texts.size(), 5u);
}

TEST_P(RandomKinds, haveTheLegsThatWereAskedFor) {
  std::set<LegKind> kinds;
  std::set<std::size_t> legs;
  std::set<int> most_motors;
  for (const Scenario& scenario : drawnOf(GetParam())) {
    const ManipulatorParameters& machine = scenario.manipulator->parameters();
    legs.insert(machine.legs.size());
    int most = 0;
    for (const Leg& leg : machine.legs) {
      kinds.insert(leg.kind);
      most = std::max(most, static_cast<int>(std::count(leg.actuated.begin(), leg.actuated.end(), true)));
    }
    most_motors.insert(most);
  }
  const bool mixed = GetParam() == RandomKind::mixture || GetParam() == RandomKind::two_motors;
  EXPECT_EQ(kinds.size(), mixed ? leg_kind_count : 1u);
  if (!mixed) {
    EXPECT_EQ(rowOf(*kinds.begin()).name, std::string(nameOf(GetParam())));
    EXPECT_THAT(legs, testing::ElementsAre(6u));
    EXPECT_THAT(most_motors, testing::ElementsAre(1));
  } else {
    EXPECT_THAT(legs, testing::IsSupersetOf({GetParam() == RandomKind::mixture ? 6u : 3u, 4u, 5u}));
    EXPECT_THAT(most_motors, testing::Contains(2));
  }
}

/// Together they drive every coordinate, have both knees, and have friction on every coordinate or on none.
TEST_P(RandomKinds, areOfEveryKind) {
  std::set<std::string> seen;
  for (const Scenario& scenario : drawnOf(GetParam())) {
    for (const Motor& motor : scenario.manipulator->motors()) seen.insert(nameOf(motor.coordinate));
    for (const Leg& leg : scenario.manipulator->parameters().legs) {
      seen.insert(leg.knee == Knee::positive ? "knee out" : "knee in");
      for (const Coordinate q : rowOf(leg.kind).coordinates)
        for (const auto& [law, value] : {std::pair{"viscous ", leg.friction.on(q)}, {"dry ", leg.coulomb.on(q)}})
          seen.insert(std::string(value > 0 ? law : "no ") + nameOf(q));
    }
  }
  for (const Coordinate q : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d}) {
    if (seen.count(std::string("no ") + nameOf(q)) == 0) continue;  // a coordinate that the kind lacks
    EXPECT_THAT(seen, testing::IsSupersetOf({std::string(nameOf(q)), std::string("viscous ") + nameOf(q),
                                             std::string("dry ") + nameOf(q)}));
  }
  EXPECT_THAT(seen, testing::IsSupersetOf({"knee out", "knee in"}));
}

/// No two legs share a non-zero number.
TEST_P(RandomKinds, haveLegsThatShareNothing) {
  for (const Scenario& scenario : drawnOf(GetParam())) {
    std::map<double, int> owners;
    const auto own = [&](int leg, double value) {
      if (value == 0) return;
      EXPECT_EQ(owners.insert({value, leg}).first->second, leg) << scenario.text << ": " << value;
    };
    for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
      const Leg& leg = scenario.manipulator->leg(i);
      for (const Link* link : {&leg.proximal, &leg.distal})
        for (const double value : {link->length, link->mass, link->inertia(0, 1)}) own(i, value);
      for (const Coordinate q : rowOf(leg.kind).coordinates)
        for (const double value : {leg.friction.on(q), leg.coulomb.on(q)}) own(i, value);
      own(i, leg.coulomb.smoothing_speed);
    }
  }
}

/// This checks more instants than the generator did.
TEST_P(RandomKinds, followTheirWholeMotion) {
  for (const Scenario& scenario : drawnOf(GetParam())) {
    const Solver<double> solver(*scenario.manipulator);
    Workspace<double> work;
    double least = INFINITY, largest = -INFINITY;
    for (int k = 0; k <= 200; ++k) {
      const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * k / 200);
      ASSERT_NO_THROW(solver.inverseKinematics(motion, work)) << scenario.text;
      solver.jacobians(motion, work);
      for (int i = 0; i < scenario.manipulator->legCount(); ++i) {
        EXPECT_GT(solver.margins(work, i).sine, 0.029) << scenario.text;
        EXPECT_LT(solver.margins(work, i).leverage, 20.5) << scenario.text;
      }
      least = std::min(least, solver.determinant(work));
      largest = std::max(largest, solver.determinant(work));
    }
    EXPECT_GT(least * largest, 0) << scenario.text;
  }
}

/// An answer does not depend on earlier questions or on the content of memory.
TEST_P(RandomKinds, areSolvedAlikeInAnyWorkspace) {
  for (const Scenario& scenario : drawnOf(GetParam())) {
    const Solver<double> solver(*scenario.manipulator);
    const auto at = [&](double share) { return scenario.trajectory->at(share * scenario.trajectory->duration()); };
    Workspace<double> fresh, used;
    solver.inverseDynamics(at(0.8), used);
    const Vector6d efforts = solver.inverseDynamics(at(0.3), fresh);
    EXPECT_EQ(solver.inverseDynamics(at(0.3), used), efforts) << scenario.text;
    solver.inverseDynamics(at(0.8), used);
    EXPECT_EQ(solver.directDynamics(at(0.3), efforts, used), solver.directDynamics(at(0.3), efforts, fresh))
        << scenario.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomKinds,
                         testing::Values(RandomKind::UPS, RandomKind::RUS, RandomKind::PUS, RandomKind::mixture,
                                         RandomKind::two_motors),
                         [](const auto& kind) {
                           std::string name = nameOf(kind.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RandomScenario, ofThePaperIsTheDefault) {
  const Scenario scenario = randomScenario(1);
  EXPECT_EQ(scenario.name, "random-1");
  EXPECT_TRUE(scenario.manipulator->isOfThePaper());
}

}  // namespace
}  // namespace ursula
