// MuJoCo's formulation beside Simbody's six balls and maximal coordinates on what ships, and far from the origin. The
// vectors and wrong parameters are in engine_kinds_test.cpp and engine_kinds_wrong_test.cpp.

#include "parts/engines/mujoco/mujoco_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "parts/engines/maximal/maximal_loop.h"
#include "simbody/simbody_loop.h"
#include "tests/support/motions.h"
#include "tests/support/numbers.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

/// One rounding for each of 24 coordinates and 24 pivots, on either side of a comparison, times a condition number that
/// stays below 1e2 for these machines near their motions.
constexpr double room = 96 * 1e2 * eps;

double largest(const Vector6d& torques) { return torques.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

/// In CI, where every test must run, a build without MuJoCo is a failure.
TEST(Mujoco, isThereInContinuousIntegration) {
  const char* ci = std::getenv("CI");
  if (ci != nullptr && std::string(ci) == "true") {
    EXPECT_TRUE(mujocoAvailable());
  }
}

/// Skips the tests in a build without MuJoCo.
class Named : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  }
};

class MujocoOnVectors : public Named {};

/// If B's origin is kilometres away, only the given p and aᵢ lose digits.
TEST_P(MujocoOnVectors, areAsGoodWhereTheOriginIsFar) {
  const Vector3d away(3000, -5000, 7000);
  const Scenario scenario = vectorScenario(GetParam());
  ManipulatorParameters parameters = scenario.manipulator->parameters();
  for (Leg& leg : parameters.legs) leg.base_point += away;
  MujocoLoop loop{Manipulator(parameters)};
  MaximalLoop maximal{Manipulator(parameters)};
  SeededDraws dice(72);
  Motion<double> motion = randomState(scenario, dice);
  motion.p += away;
  const Vector6d torques = loop.inverseDynamics(motion);
  EXPECT_LE(largest(torques - maximal.inverseDynamics(motion)), 1e3 * room * largest(torques));
  EXPECT_GT(largest(torques), 1);
}

INSTANTIATE_TEST_SUITE_P(Machines, MujocoOnVectors, testing::ValuesIn(vectorNames()), byName);

class MujocoOnScenarios : public Named {};

TEST_P(MujocoOnScenarios, agreesWithTheOtherEngines) {
  const Scenario scenario = scenarioOf(GetParam());
  MujocoLoop loop(*scenario.manipulator, scenario.load);
  MaximalLoop maximal(*scenario.manipulator, scenario.load);
  SimbodyLoop simbody(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  double size = 0, from_maximal = 0, from_simbody = 0;
  for (int k = 0; k <= 20; ++k) {
    const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * k / 20);
    const Vector6d torques = loop.inverseDynamics(motion);
    simbody.place(motion);
    size = std::max(size, largest(torques));
    from_maximal = std::max(from_maximal, largest(torques - maximal.inverseDynamics(motion)));
    from_simbody = std::max(from_simbody, largest(torques - simbody.inverseDynamics()));
  }
  const double condition =
      GetParam().rfind("near-", 0) == 0 ? 1e2 : 1;  // because of stretched legs and a singular pose
  EXPECT_GT(size, 1);
  EXPECT_LE(from_maximal, condition * room * size);
  EXPECT_LE(from_simbody, condition * room * size);
  EXPECT_GT(from_maximal, 0) << "no two formulations round alike";
  EXPECT_GT(from_simbody, 0);
  std::cout << "from maximal coordinates " << from_maximal / size << ", from Simbody " << from_simbody / size << '\n';
}

INSTANTIATE_TEST_SUITE_P(Shipped, MujocoOnScenarios, testing::ValuesIn(shippedScenarios()), byName);

TEST(MujocoLoops, areMadeWhereMujocoIsThere) {
  const Scenario scenario = vectorScenario("paper-helix");
  EXPECT_EQ(mujocoVersion() != "none", mujocoAvailable());
  if (!mujocoAvailable()) {
    EXPECT_THROW(MujocoLoop(*scenario.manipulator), std::runtime_error);
  } else {
    EXPECT_NE(makeMujocoLoop(*scenario.manipulator, nullptr), nullptr);
  }
}

}  // namespace
}  // namespace ursula
