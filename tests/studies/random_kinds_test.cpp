// Random machines of each kind of leg: their properties, and that they vary. Nothing is validated.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/machine_numbers.h"
#include "parts/fast/solver.h"
#include "tests/studies/drawn_scenarios.h"
#include "tests/support/vectors.h"
#include "tests/validation/scenario_numbers.h"

namespace ursula {
namespace {

constexpr int drawn = 60;

const std::vector<Scenario>& drawnOf(RandomKind kind) {
  if (kind == RandomKind::URS) return drawnScenarios();
  static std::map<RandomKind, std::vector<Scenario>> all;
  std::vector<Scenario>& out = all[kind];
  for (std::uint64_t seed = out.size() + 1; seed <= drawn; ++seed) out.push_back(randomScenario(seed, kind));
  return out;
}

class RandomKinds : public testing::TestWithParam<RandomKind> {};

TEST_P(RandomKinds, areTheSeeds) {
  std::set<std::string> texts;
  const std::string prefix = GetParam() == RandomKind::URS ? "" : std::string(nameOf(GetParam())) + "-";
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Scenario &first = drawnOf(GetParam())[seed - 1], again = randomScenario(seed, GetParam());
    const ManipulatorParameters &one = first.manipulator->parameters(), &other = again.manipulator->parameters();
    for (const MachineNumber& number : machineNumbers(one))
      ASSERT_EQ(number.get(one), number.get(other)) << number.path;
    const auto found = motionNumbers(*first.trajectory), same = motionNumbers(*again.trajectory);
    ASSERT_EQ(found.size(), same.size());
    for (std::size_t k = 0; k < found.size(); ++k) ASSERT_EQ(found[k].value, same[k].value) << found[k].name;
    EXPECT_EQ(first.text, again.text);
    EXPECT_EQ(first.name, "random-" + prefix + std::to_string(seed));
    texts.insert(first.text);
  }
  EXPECT_EQ(texts.size(), 10u);
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

/// Together they drive every coordinate, of the paper's kind φ alone, have both knees, and have friction on every
/// coordinate or on none.
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
    EXPECT_THAT(seen, testing::IsSupersetOf({std::string("viscous ") + nameOf(q), std::string("dry ") + nameOf(q)}));
    const bool is_passive = GetParam() == RandomKind::URS && q != Coordinate::phi;  // the paper's machine
    EXPECT_EQ(seen.count(nameOf(q)), is_passive ? 0u : 1u) << nameOf(q);
  }
  EXPECT_THAT(seen, testing::IsSupersetOf({"knee out", "knee in"}));
}

/// The numbers of legs that are equal on another leg.
std::vector<std::string> sharedByLegs(const ManipulatorParameters& machine) {
  std::map<double, std::pair<std::string, int>> owners;
  std::vector<std::string> out;
  for (const MachineNumber& number : machineNumbers(machine)) {
    const double value = number.get(machine);
    if (number.leg < 0 || value == 0) continue;
    const auto [owner, is_new] = owners.insert({value, {number.path, number.leg}});
    if (!is_new && owner->second.second != number.leg) out.push_back(owner->second.first + " = " + number.path);
  }
  return out;
}

TEST_P(RandomKinds, haveLegsThatShareNothing) {
  for (const Scenario& scenario : drawnOf(GetParam()))
    ASSERT_THAT(sharedByLegs(scenario.manipulator->parameters()), testing::IsEmpty()) << scenario.text;
}

TEST(RandomMachines, wouldBeFoundOutWithSharedLegs) {
  const ManipulatorParameters machine = drawnScenarios().front().manipulator->parameters();
  ManipulatorParameters friction = machine, twins = machine;
  friction.legs[4].coulomb.smoothing_speed = friction.legs[1].coulomb.smoothing_speed;
  EXPECT_THAT(
      sharedByLegs(friction),
      testing::ElementsAre("manipulator.leg.2.coulomb.smoothing_speed = manipulator.leg.5.coulomb.smoothing_speed"));
  twins.legs[5] = twins.legs[0];
  EXPECT_GE(sharedByLegs(twins).size(), 28u);
}

/// This checks more instants than the generator did.
TEST_P(RandomKinds, followTheirWholeMotion) {
  for (const Scenario& scenario : drawnOf(GetParam())) {
    const Solver<double> solver(*scenario.manipulator);
    Workspace<double> work;
    double least = INFINITY, largest = -INFINITY;
    for (int k = 0; k <= 400; ++k) {
      const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * k / 400);
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
                         testing::Values(RandomKind::URS, RandomKind::UPS, RandomKind::RUS, RandomKind::PUS,
                                         RandomKind::mixture, RandomKind::two_motors),
                         [](const auto& kind) { return asTestName(nameOf(kind.param)); });

TEST(RandomScenario, ofThePaperIsTheDefault) { EXPECT_EQ(randomScenario(1).text, drawnScenarios().front().text); }

}  // namespace
}  // namespace ursula
