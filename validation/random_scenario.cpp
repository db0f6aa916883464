#include "validation/random_scenario.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

#include "model/errors.h"
#include "model/trajectories.h"
#include "nocsolver/solver.h"
#include "validation/conditioning.h"

namespace ursula {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Uniform numbers that do not depend on the standard library's distributions.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// Uniform in the logarithm.
  double spread(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  Vector3d vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Matrix3d rotation(double largest) {
    const Vector3d axis = (vector(1) + Vector3d(1e-3, 0, 0)).normalized();
    return Eigen::AngleAxisd(uniform(0, largest), axis).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

/// Principal moments within the triangle inequality, turned any way.
Matrix3d randomInertia(Dice& dice, double size) {
  const Vector3d squares(dice.uniform(0.1, 1), dice.uniform(0.1, 1), dice.uniform(0.1, 1));
  const Vector3d moments(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  const Matrix3d R = dice.rotation(pi);
  const Matrix3d I = size * R * moments.asDiagonal() * R.transpose();
  return (I + I.transpose()) / 2;
}

Link randomLink(Dice& dice) {
  Link link;
  link.length = dice.uniform(1.25, 1.7);
  link.mass = dice.spread(0.5, 100);
  link.center_of_mass = dice.uniform(0.3, 0.7) * link.length;
  link.inertia = randomInertia(dice, link.mass * dice.uniform(0.05, 0.2));
  return link;
}

JointFriction randomFriction(Dice& dice, double largest) {
  return {dice.uniform(0, largest), dice.uniform(0, largest), dice.uniform(0, largest)};
}

/// Legs in two families, each turned by 0°, 120° and 240° as in Table I, then everything a little off.
Leg randomLeg(Dice& dice, int i, bool friction, bool coulomb) {
  const int family = i % 2, turn = i / 2;
  const Matrix3d R = Eigen::AngleAxisd(2 * pi / 3 * turn, Vector3d::UnitZ()).toRotationMatrix();
  const double side = family == 0 ? -1 : 1;
  Leg leg;
  leg.base_point = R * Vector3d(side * 0.0953, -1.9682, 0) + dice.vector(0.1);
  leg.platform_point = R * Vector3d(side * 0.0667, -1.38, 0) + dice.vector(0.15);
  leg.base_axis = dice.rotation(0.6) * R * Vector3d(side * 0.9397, 0, 0.342) * dice.uniform(0.5, 2);
  leg.proximal = randomLink(dice);
  leg.distal = randomLink(dice);
  leg.knee = dice.chance(0.5) ? Knee::positive : Knee::negative;
  if (friction) leg.friction = randomFriction(dice, 60);
  if (coulomb) {
    static_cast<JointFriction&>(leg.coulomb) = randomFriction(dice, 30);
    leg.coulomb.smoothing_speed = dice.spread(0.01, 0.2);
  }
  return leg;
}

ManipulatorParameters randomMachine(Dice& dice) {
  ManipulatorParameters machine;
  machine.gravity = Vector3d(0, 0, -9.81) + dice.vector(1);
  machine.platform.mass = dice.spread(30, 1500);
  machine.platform.center_of_mass = Vector3d(0, 0, dice.uniform(0, 1.9)) + dice.vector(0.3);
  machine.platform.inertia = randomInertia(dice, machine.platform.mass * dice.uniform(0.5, 1.5));
  const bool friction = dice.chance(0.6), coulomb = dice.chance(0.25);
  for (int i = 0; i < leg_count; ++i) machine.legs[static_cast<std::size_t>(i)] = randomLeg(dice, i, friction, coulomb);
  return machine;
}

std::shared_ptr<const Trajectory> randomHelix(Dice& dice) {
  HelixParameters helix;
  helix.duration = dice.spread(0.5, 8);
  helix.radius = dice.uniform(0.1, 0.2);
  helix.pitch = dice.uniform(0.7, 1.3);
  helix.start_angle = -pi / 2 + dice.uniform(-0.2, 0.2);
  helix.end_angle = helix.start_angle + dice.uniform(0.2, 0.6) * (dice.chance(0.8) ? 1 : -1);
  helix.phase = dice.uniform(-0.2, 0.2);
  // P starts between 0.7 m and 1.2 m over the base.
  helix.height_phase = dice.uniform(0.7, 1.2) / helix.pitch - helix.start_angle;
  return makeHelix(helix);
}

TimedPose randomPose(Dice& dice, double time, const Vector3d& about) {
  TimedPose pose;
  pose.time = time;
  pose.position = about + dice.vector(0.15);
  const Eigen::Quaterniond q(dice.rotation(0.3));
  pose.orientation << q.w(), q.vec();
  return pose;
}

Vector3d randomCenter(Dice& dice) { return {dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1), dice.uniform(0.8, 1.3)}; }

std::shared_ptr<const Trajectory> randomHold(Dice& dice) {
  const TimedPose pose = randomPose(dice, 0, randomCenter(dice));
  return makeHold(pose.position, pose.orientation, dice.spread(0.5, 8));
}

std::shared_ptr<const Trajectory> randomWaypoints(Dice& dice) {
  const Vector3d center = randomCenter(dice);
  std::vector<TimedPose> points;
  double t = 0;
  const int count = dice.chance(0.5) ? 3 : 4;
  for (int k = 0; k < count; ++k) {
    points.push_back(randomPose(dice, t, center));
    t += dice.spread(0.3, 2.5);
  }
  return makeWaypoints(points);
}

std::shared_ptr<const Trajectory> randomMotion(Dice& dice) {
  if (dice.chance(0.15)) return randomHold(dice);
  return dice.chance(0.5) ? randomHelix(dice) : randomWaypoints(dice);
}

std::shared_ptr<const Load> randomLoad(Dice& dice) {
  auto load = std::make_shared<Load>();
  load->force = dice.vector(800);
  load->moment = dice.vector(300);
  load->point = dice.vector(0.5);
  load->frame = dice.chance(0.5) ? Load::Frame::base : Load::Frame::platform;
  return load;
}

/// True where every leg follows the whole motion well away from singularities.
bool canBeJudged(const Scenario& scenario) {
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  constexpr int instants = 61;
  double side = 0;  // of the singular poses: the sign of det B
  for (int k = 0; k < instants; ++k) {
    const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * k / (instants - 1));
    const Conditioning c = probe.at(motion);
    if (!(c.kappa_B * c.kappa_legs < 1e4)) return false;
    solver.displacements(motion, work);
    solver.jacobians(motion, work);
    const double determinant = work.B.determinant();
    if (!(determinant * side >= 0)) return false;
    side = determinant;
  }
  return true;
}

}  // namespace

Scenario randomScenario(std::uint64_t seed) {
  Dice dice(seed);
  for (int attempt = 0; attempt < 10000; ++attempt) {
    Scenario scenario;
    scenario.name = fmt::format("random-{}", seed);
    scenario.file = scenario.name;
    scenario.text = fmt::format("seed {}", seed);
    try {
      scenario.manipulator = std::make_shared<const Manipulator>(randomMachine(dice));
      scenario.trajectory = randomMotion(dice);
      if (dice.chance(0.4)) scenario.load = randomLoad(dice);
      if (canBeJudged(scenario)) return scenario;
    } catch (const PoseError&) {  // out of reach: draw again
    } catch (const InvalidParameter&) {
    }
  }
  throw std::runtime_error(fmt::format("seed {} gave no motion that the legs can follow", seed));
}

}  // namespace ursula
