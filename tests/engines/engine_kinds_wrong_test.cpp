// The two formulations must see a wrong parameter and friction on each coordinate, and refuse a leg that cannot reach.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/engines/engine_kinds.h"
#include "tests/support/numbers.h"

namespace ursula {
namespace {

struct Wrong {
  const char* what;
  std::function<void(ManipulatorParameters&, Leg&, double)> change;  ///< by this share of itself
};

const std::vector<Wrong> wrongs = {
    {"gravity", [](auto& machine, Leg&, double by) { machine.gravity.z() *= 1 + by; }},
    {"platform.mass", [](auto& machine, Leg&, double by) { machine.platform.mass *= 1 + by; }},
    {"platform.center_of_mass", [](auto& machine, Leg&, double by) { machine.platform.center_of_mass.x() += by; }},
    {"platform.inertia", [](auto& machine, Leg&, double by) { machine.platform.inertia(1, 1) *= 1 + by; }},
    {"base_point", [](auto&, Leg& leg, double by) { leg.base_point.y() += by; }},
    {"base_axis", [](auto&, Leg& leg, double by) { leg.base_axis.z() += by; }},
    {"platform_point", [](auto&, Leg& leg, double by) { leg.platform_point.z() += by; }},
    {"proximal.mass", [](auto&, Leg& leg, double by) { leg.proximal.mass *= 1 + by; }},
    {"distal.length", [](auto&, Leg& leg, double by) { leg.distal.length *= 1 + by; }},
    {"distal.mass", [](auto&, Leg& leg, double by) { leg.distal.mass *= 1 + by; }},
    {"distal.center_of_mass", [](auto&, Leg& leg, double by) { leg.distal.center_of_mass += by; }},
    {"distal.inertia", [](auto&, Leg& leg, double by) { leg.distal.inertia *= 1 + by; }},
    {"distal.off_line", [](auto&, Leg& leg, double by) { leg.distal.off_line.x() += by; }},
    {"rotor_inertia",
     [](auto&, Leg& leg, double by) {
       for (std::size_t j = 0; j < 3; ++j)
         if (leg.actuated[j]) leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) += 10 * by;
     }},
};

/// Parameters without effect on some kinds: a carriage does not turn, and a cylinder's length only limits its stroke.
const std::vector<Wrong> at_times_idle = {
    {"proximal.length", [](auto&, Leg& leg, double by) { leg.proximal.length *= 1 + by; }},
    {"proximal.center_of_mass", [](auto&, Leg& leg, double by) { leg.proximal.center_of_mass += by; }},
    {"proximal.inertia", [](auto&, Leg& leg, double by) { leg.proximal.inertia *= 1 + by; }},
};

bool isIdle(LegKind kind, const std::string& what) {
  return kind == LegKind::PUS || (kind == LegKind::UPS && what == "proximal.length");
}

class OnEachKind : public testing::TestWithParam<int> {
 protected:
  const std::size_t leg_ = static_cast<std::size_t>(GetParam());
  const KindCase right_ = goodCase({U, T, R, P}, 102);
  const LegKind kind_ = right_.machine.legs[leg_].kind;
  const std::vector<Vector6d> efforts_ = byEngines(Manipulator(right_.machine), right_.load, right_.motion);
  const double size_ = largest(efforts_[0]);

  /// Returns the smallest change over all formulations, which must all change alike.
  double leastChange(const Wrong& wrong) {
    ManipulatorParameters parameters = right_.machine;
    wrong.change(parameters, parameters.legs[leg_], 1e-3);
    const Manipulator machine(parameters);
    const std::vector<Vector6d> changed = byEngines(machine, right_.load, right_.motion);
    const Vector6d expected = bySolver(machine, right_.load.get(), right_.motion).value();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < changed.size(); ++k) {
      least = std::min(least, largest(changed[k] - efforts_[k]));
      EXPECT_LE(largest(changed[k] - expected), room * size_) << wrong.what;
    }
    return least / size_;
  }
};

TEST_P(OnEachKind, everyParameterHasASay) {
  for (const Wrong& wrong : wrongs) EXPECT_GT(leastChange(wrong), 1e3 * room) << wrong.what;
  for (const Wrong& wrong : at_times_idle)
    EXPECT_EQ(leastChange(wrong) > 1e3 * room, !isIdle(kind_, wrong.what)) << wrong.what;
  const Wrong bend{
      "knee", [](auto&, Leg& leg, double) { leg.knee = leg.knee == Knee::positive ? Knee::negative : Knee::positive; }};
  EXPECT_EQ(leastChange(bend) > 1e-3, rowOf(kind_).knee != nullptr);
}

/// Friction on a driven coordinate acts on its motor, against its rate; on another coordinate it has an effect, too.
TEST_P(OnEachKind, frictionActsAgainstItsCoordinate) {
  const Noc<double> solver{Manipulator(right_.machine)};
  NocWorkspace<double> work;
  solver.inverseKinematics(right_.motion, work);
  const JointVariables<double> rates = solver.rates(work);
  int driven = 0;
  for (const Coordinate coordinate : rowOf(kind_).coordinates) {
    const double rate = rates.of(coordinate)(GetParam());
    for (const bool dry : {false, true}) {
      ManipulatorParameters parameters = right_.machine;
      Leg& leg = parameters.legs[leg_];
      (dry ? leg.coulomb.on(coordinate) : leg.friction.on(coordinate)) += 100;
      const double more = 100 * (dry ? std::tanh(rate / leg.coulomb.speedOf(coordinate)) : rate);
      const std::vector<Vector6d> changed = byEngines(Manipulator(parameters), right_.load, right_.motion);
      for (std::size_t k = 0; k < changed.size(); ++k) {
        const Vector6d change = changed[k] - efforts_[k];
        EXPECT_GT(largest(change), 1e3 * room * size_) << nameOf(coordinate);
        for (int m = 0; m < motor_count; ++m) {
          const Motor& motor = solver.machine().motors[static_cast<std::size_t>(m)];
          if (motor.leg != GetParam() || motor.coordinate != coordinate) continue;
          EXPECT_LE(largest(change - more * Vector6d::Unit(m)), room * size_) << nameOf(coordinate);
          ++driven;
        }
      }
    }
  }
  EXPECT_GT(driven, 0);
}

INSTANTIATE_TEST_SUITE_P(Legs, OnEachKind, testing::Range(0, 4));

/// Each way out of reach: a length that is too short or too long at a right pose.
TEST(EnginesOfKinds, refuseWhatALegCannotReach) {
  const KindCase right = goodCase({U, T, R, P}, 102);
  const auto refuses = [&](std::size_t leg, double proximal, double distal, double height = 0) {
    ManipulatorParameters parameters = right.machine;
    parameters.legs[leg].proximal.length *= proximal;
    parameters.legs[leg].distal.length *= distal;
    const Manipulator machine(parameters);
    const std::string expected = "leg " + std::to_string(leg + 1) + " cannot reach";
    Motion<double> motion = right.motion;
    motion.p.z() += height;
    const auto thrown = [&](Engine& engine) {
      try {
        engine.inverseDynamics(motion);
        return false;
      } catch (const std::domain_error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(expected));
        return true;
      }
    };
    MaximalLoop maximal(machine);
    const bool refused = thrown(maximal);
    if (mujocoAvailable()) {
      MujocoLoop loop(machine);
      EXPECT_EQ(thrown(loop), refused) << leg;
    }
    return refused;
  };
  for (std::size_t leg = 0; leg < 4; ++leg) EXPECT_FALSE(refuses(leg, 1, 1)) << leg;
  EXPECT_TRUE(refuses(0, 0.3, 0.3));
  EXPECT_TRUE(refuses(0, 0.1, 3));
  EXPECT_TRUE(refuses(1, 0.05, 1)) << "drawn out";
  EXPECT_TRUE(refuses(1, 5, 5)) << "pushed in";
  EXPECT_TRUE(refuses(2, 0.1, 1)) << "crank and rod too short";
  EXPECT_TRUE(refuses(2, 1, 0.01)) << "rod shorter than its way along u";
  EXPECT_TRUE(refuses(2, 9, 1)) << "crank too long";
  EXPECT_TRUE(refuses(3, 1, 0.4)) << "rail too far";
  EXPECT_FALSE(refuses(3, 0.1, 1)) << "a carriage's length is for drawing";
  EXPECT_TRUE(refuses(0, 1, 1, nan)) << "no number";
}

TEST(EnginesOfKinds, areAsGoodAfterAPoseOutOfReach) {
  if (!mujocoAvailable()) GTEST_SKIP() << "built without MuJoCo";
  const KindCase right = goodCase({U, T, R, P}, 102);
  MujocoLoop loop(Manipulator(right.machine), right.load);
  const Vector6d before = loop.inverseDynamics(right.motion);
  Motion<double> motion = right.motion;
  motion.p.z() += 100;
  EXPECT_THROW(loop.inverseDynamics(motion), std::domain_error);
  EXPECT_EQ(loop.inverseDynamics(right.motion), before);
  motion = right.motion;
  motion.omega.x() = nan;
  EXPECT_TRUE(loop.inverseDynamics(motion).hasNaN());
}

}  // namespace
}  // namespace ursula
