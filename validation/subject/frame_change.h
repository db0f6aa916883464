#pragma once

#include <array>
#include <memory>
#include <string>

#include "model/joint_reactions.h"
#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// What the efforts of a machine are: all moments, all forces, or of both, then a force counts as its moment at the
/// unit of length.
struct Efforts {
  const char* unit = "N m";                               ///< "N" where all motors slide
  std::array<int, motor_count> leg = {0, 1, 2, 3, 4, 5};  ///< of each motor
};

/// Units of length, mass and time, in metres, kilograms and seconds.
struct Units {
  double length = 1, mass = 1, time = 1;
  Efforts efforts = {};  ///< how they are named

  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }
  double torque() const { return force() * length; }
  double effort() const { return of(efforts.unit); }
  /// The leg, 0-based, of a motor; −1 for −1.
  int legOf(int motor) const { return motor < 0 ? motor : efforts.leg[static_cast<std::size_t>(motor)]; }
  /// A unit's size in SI: "m", "m/s^2", "N m", "rad/s", "J", … as checks write them; also as columns do ("Nm", "m_s2").
  /// 1 for a unit that is a pure number. Throws std::invalid_argument for one that it does not know.
  double of(const std::string& unit) const;
};

/// The same physics seen from elsewhere: the world turned and shifted, the platform's frame turned, legs relabelled,
/// units changed. No number that can be measured depends on it; only roundings do. A vector v of B becomes
/// turn · v / unit, a position turn · (p − origin) / unit.
struct FrameChange {
  FrameChange() = default;  ///< of a machine with six legs that turn
  /// Without turn, shift, other labels and units.
  explicit FrameChange(const Manipulator& machine);
  /// Leg i there is legs[i] here; the motors follow.
  void relabel(const Manipulator& machine, const std::array<int, leg_count>& legs);

  Matrix3d turn = Matrix3d::Identity();                 ///< of the world
  Vector3d origin = Vector3d::Zero();                   ///< the new origin, m, in B
  Matrix3d platform_turn = Matrix3d::Identity();        ///< the platform's new axes, in M
  std::array<int, leg_count> leg = {0, 1, 2, 3, 4, 5};  ///< leg i there is leg[i] here
  int legs = leg_count;
  std::array<int, motor_count> motor = {0, 1, 2, 3, 4, 5};  ///< motor k there is motor[k] here
  std::array<bool, motor_count> slides = {};                ///< of the motors here: their efforts are forces
  Units units;

  /// The unit of the effort of motor k here.
  double effort(int k) const { return slides[static_cast<std::size_t>(k)] ? units.force() : units.torque(); }

  Manipulator of(const Manipulator& machine) const;
  Motion<double> of(const Motion<double>& motion) const;
  /// Null for null.
  std::shared_ptr<const Load> of(const std::shared_ptr<const Load>& load) const;
  /// Efforts of the motors, N·m or N.
  Vector6d of(const Vector6d& torques) const;
  /// The scenario with machine, trajectory and load transformed; text and settings stay. Keeps the trajectory alive.
  Scenario of(const Scenario& scenario) const;

  // Answers from there, as they are here.
  Motion<double> back(const Motion<double>& motion) const;
  Vector6d torquesBack(const Vector6d& torques) const;
  BodyMotions<double> back(const BodyMotions<double>& bodies) const;
  /// Rates and accelerations; of displacements d and the angles ψ and θ only, for φ counts from an axis that is not
  /// turned along.
  JointMotion back(const JointMotion& joints) const;
  Reactions back(const Reactions& reactions) const;
};

/// T or Ṫ·time there, t_P = T q̇ of the driven coordinates, as it is here.
Matrix6d shapingBack(const FrameChange& there, const Matrix6d& T);

/// Any turn, shift by up to `size`, labels and units (none a power of two), reproducible from `seed`.
FrameChange randomFrameChange(unsigned seed, double size, const Manipulator& machine);

/// Where the numbers are good: origin near the machine, units of the machine's own length, mass and time, all powers of
/// two, so that nothing is rounded. Of a machine of metres about the base's origin the origin stays.
FrameChange naturalFrameChange(const Scenario& scenario);

/// A subject made in SI, asked from the origin and in the units of `there`, which has no turn and no other labels.
/// Where the subject was made for the relocated scenario, the origin is zero, and no digit is lost on the way.
Subject transformed(const Subject& subject, const FrameChange& there);

Efforts effortsOf(const Manipulator& machine);

/// The scenario with its positions from `origin` (base points and trajectory), otherwise as it is.
Scenario relocated(const Scenario& scenario, const Vector3d& origin);

}  // namespace ursula
