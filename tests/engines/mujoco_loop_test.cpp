// Compares MuJoCo's formulation with reference vectors of 25 digits, with Simbody's six balls and with maximal
// coordinates. A parameter that is wrong in one of them must be seen.

#include "engines/mujoco/mujoco_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <thread>

#include "engines/further_engines.h"
#include "engines/maximal/maximal_loop.h"
#include "engines/simbody/simbody_loop.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();
/// One rounding for each of 24 coordinates and 24 pivots, on either side of a comparison, times a condition number that
/// stays below 1e2 for these machines near their motions.
constexpr double room = 96 * 1e2 * eps;

double largest(const Vector6d& torques) { return torques.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

std::vector<std::string> shippedScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(URSULA_SCENARIOS))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Scenario shipped(const std::string& name) { return readScenario(std::string(URSULA_SCENARIOS) + "/" + name + ".toml"); }

const auto asName = [](const auto& name) {
  std::string text = name.param;
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
};

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

class MujocoOnVectors : public Named {
 protected:
  Scenario scenario_ = vectorScenario(GetParam());
};

TEST_P(MujocoOnVectors, hasTheirTorques) {
  MujocoLoop loop(*scenario_.manipulator);
  for (const VectorRow& row : vectorRows(GetParam())) {
    const Vector6d expected = row.torques.cast<double>();
    EXPECT_LE(largest(loop.inverseDynamics(rounded(row.motion)) - expected), room * largest(expected));
    EXPECT_GT(largest(expected), 1);
  }
}

/// The states have any twist and twist rate, and loads in both frames.
TEST_P(MujocoOnVectors, agreesWithTheOtherEnginesOnStatesAtRandom) {
  SeededDraws dice(71);
  for (const auto frame : {Load::Frame::base, Load::Frame::platform}) {
    const auto load = std::make_shared<Load>();
    load->force = dice.vector(500), load->moment = dice.vector(60), load->point = dice.vector(0.3);
    load->frame = frame;
    MujocoLoop loop(*scenario_.manipulator, load), unloaded(*scenario_.manipulator);
    MaximalLoop maximal(*scenario_.manipulator, load);
    SimbodyLoop simbody(*scenario_.manipulator, SimbodyLoop::Topology::six_balls, load);
    for (int k = 0; k < 10; ++k) {
      const Motion<double> motion = randomState(scenario_, dice);
      const Vector6d torques = loop.inverseDynamics(motion);
      simbody.place(motion);
      EXPECT_LE(largest(torques - maximal.inverseDynamics(motion)), room * largest(torques));
      EXPECT_LE(largest(torques - simbody.inverseDynamics()), room * largest(torques));
      EXPECT_GT(largest(torques - unloaded.inverseDynamics(motion)), 1e-3 * largest(torques)) << "the load is seen";
    }
  }
}

/// If B's origin is kilometres away, only the given p and aᵢ lose digits.
TEST_P(MujocoOnVectors, areAsGoodWhereTheOriginIsFar) {
  const Vector3d away(3000, -5000, 7000);
  ManipulatorParameters parameters = scenario_.manipulator->parameters();
  for (Leg& leg : parameters.legs) leg.base_point += away;
  MujocoLoop loop{Manipulator(parameters)};
  MaximalLoop maximal{Manipulator(parameters)};
  SeededDraws dice(72);
  Motion<double> motion = randomState(scenario_, dice);
  motion.p += away;
  const Vector6d torques = loop.inverseDynamics(motion);
  EXPECT_LE(largest(torques - maximal.inverseDynamics(motion)), 1e3 * room * largest(torques));
  EXPECT_GT(largest(torques), 1);
}

INSTANTIATE_TEST_SUITE_P(Machines, MujocoOnVectors, testing::ValuesIn(vectorNames()), asName);

class MujocoOnScenarios : public Named {};

TEST_P(MujocoOnScenarios, agreesWithTheOtherEngines) {
  const Scenario scenario = shipped(GetParam());
  MujocoLoop loop(*scenario.manipulator, scenario.load);
  MaximalLoop maximal(*scenario.manipulator, scenario.load);
  SimbodyLoop simbody(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
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

INSTANTIATE_TEST_SUITE_P(Shipped, MujocoOnScenarios, testing::ValuesIn(shippedScenarios()), asName);

struct Wrong {
  const char* what;
  std::function<void(ManipulatorParameters&, double)> change;  ///< by this share of itself
};

/// A change of every kind of parameter of a leg, the platform and the surroundings.
const std::vector<Wrong> wrongs = {
    {"gravity", [](auto& m, double by) { m.gravity.z() *= 1 + by; }},
    {"platform.mass", [](auto& m, double by) { m.platform.mass *= 1 + by; }},
    {"platform.center_of_mass", [](auto& m, double by) { m.platform.center_of_mass.x() += by; }},
    {"platform.inertia", [](auto& m, double by) { m.platform.inertia(1, 1) *= 1 + by; }},
    {"base_point", [](auto& m, double by) { m.legs[3].base_point.y() += by; }},
    {"base_axis", [](auto& m, double by) { m.legs[3].base_axis.z() += by; }},
    {"platform_point", [](auto& m, double by) { m.legs[3].platform_point.z() += by; }},
    {"proximal.length", [](auto& m, double by) { m.legs[3].proximal.length *= 1 + by; }},
    {"proximal.mass", [](auto& m, double by) { m.legs[3].proximal.mass *= 1 + by; }},
    {"proximal.center_of_mass", [](auto& m, double by) { m.legs[3].proximal.center_of_mass *= 1 + by; }},
    {"proximal.inertia", [](auto& m, double by) { m.legs[3].proximal.inertia(0, 0) *= 1 + by; }},
    {"distal.length", [](auto& m, double by) { m.legs[3].distal.length *= 1 + by; }},
    {"distal.mass", [](auto& m, double by) { m.legs[3].distal.mass *= 1 + by; }},
    {"distal.center_of_mass", [](auto& m, double by) { m.legs[3].distal.center_of_mass *= 1 + by; }},
    {"distal.inertia", [](auto& m, double by) { m.legs[3].distal.inertia(0, 0) *= 1 + by; }},
    {"friction.phi", [](auto& m, double by) { m.legs[3].friction.phi += by; }},
    {"friction.psi", [](auto& m, double by) { m.legs[3].friction.psi += by; }},
    {"friction.theta", [](auto& m, double by) { m.legs[3].friction.theta += by; }},
    {"coulomb.phi", [](auto& m, double by) { m.legs[3].coulomb.phi += by; }},
    {"coulomb.psi", [](auto& m, double by) { m.legs[3].coulomb.psi += by; }},
    {"coulomb.theta", [](auto& m, double by) { m.legs[3].coulomb.theta += by; }},
};

/// Control: every parameter has an effect, which is the same as in the other formulation.
TEST(MujocoLoops, seeEveryParameterAsTheMaximalCoordinatesDo) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  const Scenario scenario = shipped("proving-ground");
  SeededDraws dice(73);
  const Motion<double> motion = randomState(scenario, dice);
  const Vector6d right = MujocoLoop(*scenario.manipulator, scenario.load).inverseDynamics(motion);
  for (const Wrong& wrong : wrongs) {
    ManipulatorParameters parameters = scenario.manipulator->parameters();
    wrong.change(parameters, 1e-4);
    const Manipulator machine(parameters);
    const Vector6d changed = MujocoLoop(machine, scenario.load).inverseDynamics(motion);
    EXPECT_GT(largest(changed - right), 1e3 * room * largest(right)) << wrong.what;
    EXPECT_LE(largest(changed - MaximalLoop(machine, scenario.load).inverseDynamics(motion)), room * largest(right))
        << wrong.what;
  }
}

/// The other knee makes another machine.
TEST(MujocoLoops, bendEachKneeAsItIsToldTo) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  const Scenario scenario = shipped("paper-helix");
  const Motion<double> motion = scenario.trajectory->at(1);
  const Vector6d right = MujocoLoop(*scenario.manipulator).inverseDynamics(motion);
  for (std::size_t leg = 0; leg < leg_count; ++leg) {
    ManipulatorParameters parameters = scenario.manipulator->parameters();
    parameters.legs[leg].knee = Knee::negative;
    const Manipulator machine(parameters);
    const Vector6d torques = MujocoLoop(machine).inverseDynamics(motion);
    EXPECT_LE(largest(torques - MaximalLoop(machine).inverseDynamics(motion)), room * largest(torques));
    EXPECT_GT(largest(torques - right), 1e-3 * largest(right)) << "leg " << leg + 1;
  }
}

/// Answers are equal to the last bit on any thread, whatever was asked before.
TEST(MujocoLoops, answerAlikeWhateverWasAskedBefore) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  const Scenario scenario = shipped("proving-ground");
  const auto answer = [&](bool asked_before) {
    MujocoLoop loop(*scenario.manipulator, scenario.load);
    if (asked_before) loop.inverseDynamics(scenario.trajectory->at(0.3));
    return loop.inverseDynamics(scenario.trajectory->at(0.7));
  };
  const Vector6d expected = answer(false);
  EXPECT_EQ(answer(true), expected);
  std::array<Vector6d, 4> found;
  std::vector<std::thread> threads;
  for (Vector6d& each : found) threads.emplace_back([&] { each = answer(true); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(found, testing::Each(expected));
}

TEST(MujocoLoops, refuseAPoseOutOfReachAndOneThatIsNoNumber) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  const Scenario scenario = shipped("paper-helix");
  MujocoLoop loop(*scenario.manipulator);
  Motion<double> motion = scenario.trajectory->at(1);
  const Vector6d right = loop.inverseDynamics(motion);
  for (const double height : {5.0, std::numeric_limits<double>::quiet_NaN()}) {
    motion.p.z() += height;
    try {
      loop.inverseDynamics(motion);
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::domain_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("leg 1 cannot reach"));
    }
  }
  EXPECT_EQ(loop.inverseDynamics(scenario.trajectory->at(1)), right) << "and is as good as before";
  motion = scenario.trajectory->at(1);
  motion.omega.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(loop.inverseDynamics(motion).hasNaN());
}

TEST(MujocoLoops, areMadeWhereMujocoIsThere) {
  const Scenario scenario = shipped("paper-helix");
  EXPECT_EQ(makeFurtherEngines(*scenario.manipulator, nullptr)[2] != nullptr, mujocoAvailable());
  EXPECT_EQ(mujocoVersion() != "none", mujocoAvailable());
  if (!mujocoAvailable()) {
    EXPECT_THROW(MujocoLoop(*scenario.manipulator), std::runtime_error);
  }
}

}  // namespace
}  // namespace ursula
