// Well-scaled numbers: natural units and origins lose no digit, and a motion far from the base's origin keeps its
// digits.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/exact_trajectory.h"
#include "model/trajectories/trajectories.h"
#include "parts/fast/solver.h"
#include "parts/random/random_scenario.h"
#include "tests/validation/scenario_files.h"
#include "tests/validation/transformed_numbers.h"

namespace ursula {
namespace {

bool isPowerOfTwo(double x) {
  int exponent = 0;
  return x > 0 && std::frexp(x, &exponent) == 0.5;
}

/// The scenario with its base moved by `by` and its motion unchanged.
Scenario movedBase(Scenario scenario, const Vector3d& by) {
  ManipulatorParameters machine = scenario.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.base_point += by;
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  return scenario;
}

void expectExact(const Scenario& scenario, const FrameChange& natural) {
  for (double unit : {natural.units.length, natural.units.mass, natural.units.time}) EXPECT_TRUE(isPowerOfTwo(unit));
  EXPECT_EQ(natural.turn, Matrix3d::Identity());
  EXPECT_EQ(natural.platform_turn, Matrix3d::Identity());
  const Manipulator& machine = *scenario.manipulator;
  EXPECT_TRUE(numbersOf(inverse(natural).transformed(natural.transformed(machine))) == numbersOf(machine));
  if (scenario.load) {
    EXPECT_TRUE(numbersOf(*inverse(natural).transformed(natural.transformed(scenario.load))) ==
                numbersOf(*scenario.load));
  }
  const double length = Solver<double>(machine).length();
  EXPECT_LT(length, 2 * natural.units.length);
  EXPECT_GE(length, natural.units.length);
}

TEST(NaturalFrameChange, losesNoDigitOfAnyShippedMachine) {
  for (const char* name : {"paper-helix", "proving-ground", "millimetres", "light-legs", "heavy-legs", "full-tensors",
                           "load-table", "gravity-off", "hold", "random-5"}) {
    SCOPED_TRACE(name);
    const Scenario scenario = scenarioOf(name);
    const FrameChange natural = naturalFrameChange(scenario);
    expectExact(scenario, natural);
    EXPECT_EQ(natural.origin, Vector3d::Zero());
    const Motion<double> motion = scenario.trajectory->at(0.3 * scenario.trajectory->duration());
    EXPECT_TRUE(numbersOf(inverse(natural).transformed(natural.transformed(motion))) == numbersOf(motion));
  }
}

TEST(NaturalFrameChange, losesNoDigitOfRandomMachines) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario scenario = randomScenario(seed);
    expectExact(scenario, naturalFrameChange(scenario));
  }
}

/// If the base is near its origin, the origin stays; farther away it moves to the base.
TEST(NaturalFrameChange, losesNoDigitWhereverTheBaseIs) {
  const Scenario helix = scenarioOf("paper-helix");
  double largest = 0;
  for (double distance = 0.3; distance < 1e7; distance *= 1.37)
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0.1, -0.9, 0.5), Vector3d(-0.6, 0.6, -0.52)}) {
      SCOPED_TRACE(distance);
      const Scenario moved = movedBase(helix, distance * direction);
      const FrameChange natural = naturalFrameChange(moved);
      expectExact(moved, natural);
      const Scenario near = relocated(moved, natural.origin);
      double furthest = 0;
      for (const Leg& leg : near.manipulator->parameters().legs)
        furthest = std::max(furthest, leg.base_point.cwiseAbs().maxCoeff());
      EXPECT_LE(furthest, 32 * natural.units.length);
      largest = std::max(largest, natural.origin.norm());
    }
  EXPECT_GT(largest, 1e6) << "no origin was moved";
}

/// A quaternion of a rotation by `angle` about `axis`.
Eigen::Vector4d quaternion(double angle, const Vector3d& axis) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, axis.normalized()));
  return {q.w(), q.x(), q.y(), q.z()};
}

std::vector<TimedPose> poses(const Vector3d& at, int count) {
  std::vector<TimedPose> out;
  for (int k = 0; k < count; ++k) {
    const double t = 3.0 * k / (count - 1);
    out.push_back({t, at + Vector3d(0.1 * std::sin(t), 0.2 * std::cos(2 * t), 1 + 0.1 * std::sin(3 * t)),
                   quaternion(0.2 * std::sin(t), {1, t, 0.5})});
  }
  return out;
}

std::unique_ptr<Trajectory> helixAt(double height) {
  HelixParameters helix;
  helix.radius = 0.2, helix.pitch = 1.2, helix.start_angle = -1.5707963267948966, helix.end_angle = -1.0471975511965976;
  helix.height_phase = 2.2 + height / helix.pitch;
  return makeHelix(helix);
}

struct Far {
  const char* name;
  std::function<std::unique_ptr<Trajectory>(double distance)> make;
};

const std::vector<Far> far_motions = {
    {"helix", [](double distance) { return helixAt(distance); }},
    {"waypoints",
     [](double distance) {
       return makeWaypoints(poses({0.3 * distance, -0.2 * distance, distance}, 4));
     }},
    {"samples",
     [](double distance) {
       return makeSamples(poses({0.3 * distance, -0.2 * distance, distance}, 31));
     }},
    {"hold", [](double distance) {
       return makeHold({0.3 * distance, -0.2 * distance, distance + 1.1}, quaternion(0.3, {1, 2, 3}), 3);
     }}};

/// The largest distance, m, of `motion`, moved back, from `exact`.
double distanceFrom(const Trajectory& exact, const std::function<Vector3d(double t)>& position,
                    const Vector3d& origin) {
  double largest = 0;
  for (int k = 0; k <= 50; ++k) {
    const double t = 3.0 * k / 50;
    const Vector3<Real50> right = exact.at(Real50(t)).p - origin.cast<Real50>();
    largest = std::max(largest, (position(t).cast<Real50>() - right).norm().convert_to<double>());
  }
  return largest;
}

/// A machine of some 1.4 m.
constexpr double size = 1.4;

TEST(RelocatedTrajectories, keepTheirDigitsFarFromTheBasesOrigin) {
  for (const Far& far : far_motions)
    for (double distance : {1e3, 1e5}) {
      SCOPED_TRACE(std::string(far.name) + " at " + std::to_string(distance));
      const auto whole = far.make(distance);
      const double beside = far.name == std::string("helix") ? 0 : distance;
      const Vector3d origin = (Vector3d(0.3 * beside, -0.2 * beside, distance) / 8).array().round() * 8;
      const std::unique_ptr<Trajectory> near = whole->relativeTo(origin);
      ASSERT_NE(near, nullptr);
      const double error = distanceFrom(
          *whole, [&](double t) { return near->at(t).p; }, origin);
      std::cout << far.name << " at " << distance << " m: " << error / size << " of the machine's size\n";
      // A helix's quintic β(t) alone rounds by as much at any place.
      EXPECT_LE(error, (far.name == std::string("helix") ? 1.2e-15 : 1e-15) * size);
      EXPECT_EQ(near->kind(), whole->kind());
      EXPECT_EQ(near->duration(), whole->duration());
      EXPECT_EQ(near->knots(), whole->knots());
      for (double t : {0.1, 1.7}) {
        EXPECT_EQ(near->at(t).Q, whole->at(t).Q);
        EXPECT_LE((near->at(Real50(t)).p + origin.cast<Real50>() - whole->at(Real50(t)).p).norm().convert_to<double>(),
                  1e-40);
      }
      // Control: the rounded motion minus the origin has lost digits by its distance.
      if (far.name == std::string("hold")) continue;  // it has one rounding, that of the given position
      EXPECT_GT(distanceFrom(
                    *whole, [&](double t) { return Vector3d(whole->at(t).p - origin); }, origin),
                1e-14 * distance / 1e3);
    }
}

/// Two moves equal one by their sum.
TEST(RelocatedTrajectories, moveOnFromWhereTheyAre) {
  for (const Far& far : far_motions) {
    const auto whole = far.make(1e3);
    const Vector3d first(256, -192, 960), second(32, -16, 40);
    const auto twice = whole->relativeTo(first)->relativeTo(second), once = whole->relativeTo(first + second);
    EXPECT_LE((twice->at(0.7).p - once->at(0.7).p).norm(), 1e-12) << far.name;
    EXPECT_GT((twice->at(0.7).p - whole->relativeTo(first)->at(0.7).p).norm(), 1) << far.name;
  }
}

/// A trajectory that cannot move its origin, so that it is shifted from outside.
class Immovable final : public ExactTrajectory {
 public:
  std::string kind() const override { return "immovable"; }
  double duration() const override { return whole_->duration(); }
  Motion<double> at(double t) const override { return whole_->at(t); }
  Motion<Real50> at(const Real50& t) const override { return whole_->at(t); }

 private:
  std::unique_ptr<Trajectory> whole_ = helixAt(0);
};

TEST(Relocated, shiftsWhatCannotMoveItself) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.trajectory = std::make_shared<const Immovable>();
  const Vector3d origin(8, -16, 24);
  const Scenario moved = relocated(scenario, origin);
  EXPECT_EQ(moved.trajectory->at(1.0).p, Vector3d(scenario.trajectory->at(1.0).p - origin));
  EXPECT_EQ(moved.trajectory->at(1.0).Q, scenario.trajectory->at(1.0).Q);
  EXPECT_EQ(moved.manipulator->leg(2).base_point, Vector3d(scenario.manipulator->leg(2).base_point - origin));
  EXPECT_EQ(relocated(scenario, Vector3d::Zero()).trajectory, scenario.trajectory);
}

}  // namespace
}  // namespace ursula
