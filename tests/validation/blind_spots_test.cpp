// What a scenario cannot show: each planted mistake is listed, the same machine without the plant does not list it, and
// every listed number makes no difference.

#include "validation/blind_spots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/trajectories/trajectories.h"
#include "parts/exchange/mechanism_reader.h"
#include "validation/subject/parameters.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

Scenario starting(const std::string& kind) {
  return readScenario(std::string(URSULA_SOURCE) + "/apps/starting/" + kind + ".toml");
}

Scenario changed(Scenario scenario, const std::function<void(ManipulatorParameters&)>& change) {
  ManipulatorParameters machine = scenario.manipulator->parameters();
  change(machine);
  scenario.manipulator = std::make_shared<Manipulator>(machine);
  return scenario;
}

std::vector<BlindSpot> blind(const Scenario& scenario) { return partBlindSpots()->manipulator(scenario); }

bool lists(const std::vector<BlindSpot>& blind, const NamedCause& cause) {
  return std::any_of(blind.begin(), blind.end(), [&](const BlindSpot& one) {
    return one.cause.kind == cause.kind && one.cause.term == cause.term && one.cause.body == cause.body &&
           one.cause.leg == cause.leg && one.cause.parameter == cause.parameter;
  });
}

using Change = void (*)(ManipulatorParameters&);

struct Plant {
  const char* name;
  Change change;
  NamedCause cause;
};

void atMiddle(Link& link) { link.center_of_mass = link.length / 2; }
void nearEnd(Link& link) { link.center_of_mass = 0.3 * link.length; }

/// A machine that shows all that the plants hide.
void tell(ManipulatorParameters& machine) {
  machine.platform.center_of_mass += Vector3d(0.02, 0.03, 0.01);
  const double I = machine.platform.inertia(0, 0);
  machine.platform.inertia = Vector3d(I, 1.2 * I, 1.5 * I).asDiagonal();
  for (Leg& leg : machine.legs) {
    nearEnd(leg.proximal), nearEnd(leg.distal);
    leg.friction.on(rowOf(leg.kind).coordinates[0]) = 1;
  }
}

const Plant plants[] = {
    {"noGravity",
     [](ManipulatorParameters& m) { m.gravity.setZero(); },
     {CauseKind::missing_term, "gravity", "platform"}},
    {"noGravityOfLinks",
     [](ManipulatorParameters& m) { m.gravity.setZero(); },
     {CauseKind::missing_term, "gravity", "distal"}},
    {"noFriction",
     [](ManipulatorParameters& m) {
       for (Leg& leg : m.legs) leg.friction = {};
     },
     {CauseKind::missing_term, "friction", "all"}},
    {"massCentreAtP",
     [](ManipulatorParameters& m) { m.platform.center_of_mass.setZero(); },
     {CauseKind::reference_point, "", "platform"}},
    {"roundPlatform",
     [](ManipulatorParameters& m) { m.platform.inertia = 10 * Matrix3d::Identity(); },
     {CauseKind::missing_term, "gyroscopic", "platform"}},
    {"tensorOfEveryFrame",
     [](ManipulatorParameters& m) { m.platform.inertia = 10 * Matrix3d::Identity(); },
     {CauseKind::frame, "inertia", "platform"}},
    {"middles",
     [](ManipulatorParameters& m) {
       for (Leg& leg : m.legs) atMiddle(leg.distal);
     },
     {CauseKind::reference_point, "", "distal"}},
    {"middleOfOne",
     [](ManipulatorParameters& m) { atMiddle(m.legs[3].distal); },
     {CauseKind::reference_point, "", "distal", "", "", {}, {}, {}, 4}},
};

/// A motion that turns and moves at once, about the middle of the scenario's.
Scenario turning(Scenario scenario) {
  const Motion<double> middle = scenario.trajectory->at(scenario.trajectory->duration() / 2);
  std::vector<TimedPose> poses;
  for (const auto& [x, y, z] : {std::tuple(0.0, 0.0, 0.0), {0.1, -0.06, 0.08}, {-0.05, 0.1, -0.07}, {0.0, 0.0, 0.0}}) {
    const Eigen::AngleAxisd turn(Vector3d(x, y, z).norm(), Vector3d(x + 1e-9, y, z).normalized());
    const Eigen::Quaterniond q(Matrix3d(turn.toRotationMatrix() * middle.Q));
    poses.push_back({0.5 * static_cast<double>(poses.size()), middle.p + 0.3 * Vector3d(z, x, y),
                     Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())});
  }
  scenario.trajectory = makeWaypoints(poses);
  return scenario;
}

class Planted : public testing::TestWithParam<std::tuple<const char*, Plant>> {};

TEST_P(Planted, isListedAndElseNot) {
  const auto& [kind, plant] = GetParam();
  const Scenario telling = changed(turning(starting(kind)), tell);
  EXPECT_TRUE(lists(blind(changed(telling, plant.change)), plant.cause));
  for (const BlindSpot& one : blind(telling))
    EXPECT_FALSE(lists({one}, plant.cause) && plant.cause.kind != CauseKind::reference_point &&
                 plant.cause.kind != CauseKind::frame)
        << one.mistake;
}

INSTANTIATE_TEST_SUITE_P(Kinds, Planted, testing::Combine(testing::Values("URS", "RUS"), testing::ValuesIn(plants)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + std::get<1>(test.param).name;
                         });

/// The largest change of an effort of the scenario's motion, as a share.
double changeBy(const Scenario& scenario, const Scenario& other) {
  double most = 0, off = 0;
  const Subject right = nocSubject(*scenario.manipulator, scenario.load),
                wrong = nocSubject(*other.manipulator, other.load);
  for (int k = 0; k <= 200; ++k) {
    const Motion<double> at = scenario.trajectory->at(scenario.trajectory->duration() * k / 200);
    const Vector6d efforts = right.torques(at);
    most = std::max(most, efforts.cwiseAbs().maxCoeff());
    off = std::max(off, (wrong.torques(at) - efforts).cwiseAbs().maxCoeff());
  }
  return off / most;
}

TEST(BlindSpots, areNumbersWithoutEffect) {
  const Scenario scenario = readScenario(std::string(URSULA_SOURCE) + "/scenarios/paper-helix.toml");
  const std::vector<BlindSpot> found = blind(scenario);
  int blind_numbers = 0;
  for (const MachineNumber& number : machineNumbers(scenario.manipulator->parameters())) {
    if (number.leg >= 0 || number.quantity != Quantity::platform_inertia || number.entry >= 3) continue;
    const Scenario other = changed(scenario, [&](ManipulatorParameters& m) { number.set(m, 1.1 * number.get(m)); });
    const bool listed = lists(found, {CauseKind::parameter, "", "platform", number.path});
    blind_numbers += listed ? 1 : 0;
    EXPECT_EQ(changeBy(scenario, other) < 1e-12, listed) << number.path;
  }
  EXPECT_EQ(blind_numbers, 1) << "the helix turns about one axis";
}

TEST(BlindSpots, areThoseOfAllLegsOnce) {
  const Scenario scenario = changed(starting("URS"), [](ManipulatorParameters& m) { m.gravity.setZero(); });
  for (const BlindSpot& one : blind(scenario))
    EXPECT_TRUE(one.cause.term != "gravity" || one.cause.leg == 0) << one.mistake;
}

TEST(BlindSpots, areMoreUnderATolerance) {
  Scenario scenario = starting("URS");
  const NamedCause spin{CauseKind::missing_term, "spin", "distal"};
  EXPECT_FALSE(lists(blind(scenario), spin));
  scenario.tolerance = EffortTolerance{0.05, 0};
  const std::vector<BlindSpot> wide = blind(scenario);
  EXPECT_TRUE(lists(wide, spin));
  for (const BlindSpot& one : wide) EXPECT_LE(one.largest, 0.05) << one.mistake;
}

TEST(BlindSpots, ofAPlanarMechanism) {
  const MechanismScenario fourbar =
      readMechanism(URSULA_SOURCE "/scenarios/mechanisms/fourbar.toml", &exchange::readMechanismModel);
  const std::vector<BlindSpot> found = partBlindSpots()->mechanism(fourbar);
  const auto listed = [&](const char* parameter) {
    return std::any_of(found.begin(), found.end(),
                       [&](const BlindSpot& one) { return one.cause.parameter == parameter; });
  };
  EXPECT_TRUE(listed("body.coupler.inertia.xx")) << "all turns are about y";
  EXPECT_FALSE(listed("body.coupler.inertia.yy"));
  EXPECT_FALSE(listed("body.coupler.mass"));
  EXPECT_TRUE(lists(found, {CauseKind::missing_term, "gyroscopic", "all"}));
  EXPECT_FALSE(lists(found, {CauseKind::missing_term, "gravity", "all"}));
}

}  // namespace
}  // namespace ursula
