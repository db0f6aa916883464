// Transforms whole scenarios into a change of frame, and creates the changes of frame in use. See frame_change.h.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "model/exact_trajectory.h"
#include "nocsolver/noc/noc.h"
#include "validation/subject/frame_change.h"

namespace ursula {
namespace {

/// A trajectory in a change of frame.
class TransformedTrajectory final : public ExactTrajectory {
 public:
  TransformedTrajectory(std::shared_ptr<const Trajectory> from, const FrameChange& frame_change)
      : from_(std::move(from)), frame_change_(frame_change), knots_(from_->knots()) {
    for (double& knot : knots_) knot /= frame_change.units.time;
  }
  std::string kind() const override { return from_->kind(); }
  double duration() const override { return from_->duration() / frame_change_.units.time; }
  Motion<double> at(double t) const override { return changed(t); }
  Motion<Real50> at(const Real50& t) const override { return changed(t); }
  const ExactTrajectory* exact() const override { return from_->exact() ? this : nullptr; }
  const std::vector<double>& knots() const override { return knots_; }

 private:
  template <class S>
  Motion<S> changed(const S& t) const {
    Motion<S> motion = frame_change_.transformed(from_->at(S(t * frame_change_.units.time)));
    motion.t = t;  // the requested instant, to the last bit
    return motion;
  }

  std::shared_ptr<const Trajectory> from_;
  FrameChange frame_change_;
  std::vector<double> knots_;
};

std::shared_ptr<const Trajectory> shifted(const std::shared_ptr<const Trajectory>& from, const Vector3d& origin) {
  if (origin.isZero(0)) return from;
  if (std::shared_ptr<const Trajectory> moved = from->relativeTo(origin)) return moved;
  FrameChange shift;
  shift.origin = origin;
  return std::make_shared<const TransformedTrajectory>(from, shift);
}

double powerOfTwo(double x) { return std::exp2(std::floor(std::log2(x))); }

/// Returns an origin of multiples of a power of two above the machine's size; subtracting it causes no rounding
/// (Sterbenz). The first multiple is excluded, because coordinates near it are too small.
Vector3d roundOrigin(const Manipulator& machine, double length) {
  Vector3d middle = Vector3d::Zero();
  for (const Leg& leg : machine.parameters().legs) middle += leg.base_point / machine.legCount();
  double spread = length;
  for (const Leg& leg : machine.parameters().legs) spread = std::max(spread, (leg.base_point - middle).norm());
  const double grid = 4 * powerOfTwo(spread);
  const Vector3d steps = (middle / grid).array().round();
  return (steps.array().abs() < 2).select(Vector3d::Zero(), steps * grid);
}

/// The largest acceleration of the platform or of gravity, m/s².
double accelerationOf(const Scenario& scenario, double length) {
  double largest = scenario.manipulator->gravity().norm();
  constexpr int instants = 16;
  for (int k = 0; k <= instants; ++k) {
    const Motion<double> motion = scenario.trajectory->at(scenario.trajectory->duration() * k / instants);
    largest = std::max(
        {largest, motion.p_ddot.norm(), length * motion.omega_dot.norm(), length * motion.omega.squaredNorm()});
  }
  return largest;
}

double massOf(const ManipulatorParameters& machine) {
  double mass = machine.platform.mass;
  for (const Leg& leg : machine.legs) mass += leg.proximal.mass + leg.distal.mass;
  return mass;
}

Matrix3d randomTurn(std::mt19937_64& engine) {
  // Four sums of twelve uniform numbers are nearly normal and form a quaternion; the exact distribution does not
  // matter.
  const auto normal = [&engine] {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(engine() >> 11) * 0x1p-53;
    return sum;
  };
  Eigen::Quaterniond q(normal(), normal(), normal(), normal());
  return q.normalized().toRotationMatrix();
}

/// `back` is the inverse of `to`.
KinematicAnswer answerIn(const FrameChange& to, const FrameChange& back, KinematicAnswer answer) {
  answer.joints = back.back(answer.joints);
  answer.bodies = back.back(answer.bodies);
  for (Matrix6d* T : {&answer.T, &answer.T_rate}) *T = shapingBack(back, *T);
  answer.T_rate *= to.units.time;
  return answer;
}

/// If some motors rotate and some slide, their efforts are compared by their numbers. So a machine of usual size gets 1
/// m as its unit of length, and a newton counts as a newton metre.
double lengthUnit(const Manipulator& machine, double length) {
  constexpr double usual = 64;
  const Motors& motors = machine.motors();
  const auto pushing = std::count_if(motors.begin(), motors.end(), [](const Motor& motor) { return motor.slides(); });
  const bool mixed = pushing > 0 && pushing < motor_count;
  return mixed && length > 1 / usual && length < usual ? 1 : powerOfTwo(length);
}

}  // namespace

Scenario relocated(const Scenario& scenario, const Vector3d& origin) {
  Scenario out = scenario;
  ManipulatorParameters machine = scenario.manipulator->given();
  for (Leg& leg : machine.legs) leg.base_point -= origin;
  out.manipulator = std::make_shared<const Manipulator>(machine);
  out.trajectory = shifted(scenario.trajectory, origin);
  return out;
}

FrameChange FrameChange::unshifted() const {
  FrameChange out = *this;
  out.origin.setZero();
  return out;
}

Scenario FrameChange::transformed(const Scenario& scenario) const {
  Scenario out = scenario;
  out.manipulator = std::make_shared<const Manipulator>(transformed(*scenario.manipulator));
  FrameChange about_origin = *this;
  about_origin.origin.setZero();
  out.trajectory = std::make_shared<const TransformedTrajectory>(shifted(scenario.trajectory, origin), about_origin);
  out.load = transformed(scenario.load);
  return out;
}

FrameChange randomFrameChange(unsigned seed, double size, const Manipulator& machine) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  FrameChange out(machine);
  out.turn = randomTurn(engine);
  out.platform_turn = randomTurn(engine);
  out.origin = size * Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  PerLeg<int> legs = out.leg;
  for (std::size_t i = machine.parameters().legs.size() - 1; i > 0; --i) std::swap(legs[i], legs[engine() % (i + 1)]);
  out.relabel(machine, legs);
  out.units = {uniform(0.6, 1.9), uniform(0.6, 1.9), uniform(0.6, 1.9), {}};
  return out;
}

FrameChange naturalFrameChange(const Scenario& scenario) {
  const double length = MachineParameters<double>(*scenario.manipulator).length;
  const double acceleration = accelerationOf(scenario, length);
  FrameChange out(*scenario.manipulator);
  out.origin = roundOrigin(*scenario.manipulator, length);
  out.units.efforts = effortsOf(*scenario.manipulator);
  out.units.length = lengthUnit(*scenario.manipulator, length);
  out.units.mass = powerOfTwo(massOf(scenario.manipulator->parameters()));
  out.units.time = powerOfTwo(acceleration > 0 ? std::sqrt(length / acceleration) : scenario.trajectory->duration());
  return out;
}

Subject transformed(const Subject& subject, const FrameChange& to) {
  const Units units = to.units;
  FrameChange from = to;
  from.origin = -to.origin / units.length;
  from.units = {1 / units.length, 1 / units.mass, 1 / units.time, units.efforts};
  Subject out;
  static_cast<JudgedSubject&>(out) = subject;
  out.most_questions = subject.most_questions;
  out.torques = [=](const Motion<double>& motion) { return to.transformed(subject.torques(from.transformed(motion))); };
  if (subject.foresee)
    out.foresee = [=](std::vector<Motion<double>> motions) {
      for (Motion<double>& motion : motions) motion = from.transformed(motion);
      subject.foresee(motions);
    };
  if (subject.answers)
    out.answers = [=] {
      std::vector<Answered> all = subject.answers();
      for (Answered& each : all) each = {each.t / units.time, to.transformed(each.torques)};
      return all;
    };
  if (subject.kinematics)
    out.kinematics = [=](const Motion<double>& motion) {
      return answerIn(to, from, subject.kinematics(from.transformed(motion)));
    };
  if (subject.accelerations)
    out.accelerations = [=](const Motion<double>& motion, const Vector6d& torques) {
      Vector6d found = subject.accelerations(from.transformed(motion), from.transformed(torques));
      found.head<3>() *= units.time * units.time;
      found.tail<3>() /= units.acceleration();
      return found;
    };
  if (subject.complement)
    out.complement = [=](const Motion<double>& motion) {
      Complement found = subject.complement(from.transformed(motion));
      for (Eigen::Index body = 0; body < body_count; ++body) {
        found.T.middleRows(6 * body + 3, 3) /= units.length;
        found.D.middleCols(6 * body + 3, 3) *= units.length;
      }
      return found;
    };
  if (subject.reactions)
    out.reactions = [=](const Motion<double>& motion) {
      return from.back(subject.reactions(from.transformed(motion)));
    };
  if (subject.rebuilt)
    out.rebuilt = [=](const Manipulator& machine) {
      FrameChange there(machine);  // its motors may have another order
      there.origin = to.origin;
      there.units = to.units;
      return transformed(subject.rebuilt(from.transformed(machine)), there);
    };
  return out;
}

}  // namespace ursula
