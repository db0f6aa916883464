#pragma once

#include <array>
#include <memory>
#include <string>

#include "model/joint_variables.h"
#include "model/load.h"
#include "model/manipulator.h"
#include "model/motion.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// The kind of a machine's efforts: all moments, all forces, or both. In the last case a force counts as its moment at
/// the unit of length.
struct Efforts {
  const char* unit = "N m";                ///< "N" if all motors slide
  PerMotor<int> leg = {0, 1, 2, 3, 4, 5};  ///< leg of each motor
};

/// Units of length, mass and time, in metres, kilograms and seconds.
struct Units {
  double length = 1, mass = 1, time = 1;
  Efforts efforts = {};  ///< names of the efforts

  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }
  double torque() const { return force() * length; }
  double effort() const { return sizeOf(efforts.unit); }
  /// Returns the leg, 0-based, of a motor; −1 for −1.
  int legOf(int motor) const { return motor < 0 ? motor : efforts.leg[motor]; }
  /// Returns a unit's size in SI: "m", "m/s^2", "N m", "rad/s", "J", … as in checks, or as in columns ("Nm", "m_s2").
  /// It is 1 for a pure number. Throws std::invalid_argument for an unknown unit.
  double sizeOf(const std::string& unit) const;
};

/// The same physics in another frame: the world rotated and shifted, the platform's frame rotated, legs relabelled,
/// units changed. No measurable number depends on it; only roundings do. A vector v of B becomes turn · v / unit, a
/// position turn · (p − origin) / unit.
struct FrameChange {
  FrameChange() = default;  ///< for a machine with six legs and rotating motors
  /// The identity for this machine.
  explicit FrameChange(const Manipulator& machine);
  /// Leg i in the new frame is legs[i] in the old one; the motors follow.
  void relabel(const Manipulator& machine, const PerLeg<int>& legs);

  Matrix3d turn = Matrix3d::Identity();           ///< rotation of the world
  Vector3d origin = Vector3d::Zero();             ///< the new origin, m, in B
  Matrix3d platform_turn = Matrix3d::Identity();  ///< the platform's new axes, in M
  PerLeg<int> leg = {0, 1, 2, 3, 4, 5};           ///< leg i in the new frame is leg[i] in the old one
  int legs = leg_count;
  PerMotor<int> motor = {0, 1, 2, 3, 4, 5};  ///< motor k in the new frame is motor[k] in the old one
  PerMotor<bool> slides = {};                ///< old motors whose efforts are forces
  Units units;

  /// The unit of the effort of the old motor k.
  double effort(int k) const { return slides[k] ? units.force() : units.torque(); }

  Manipulator transformed(const Manipulator& machine) const;
  template <class S>  // double or Real50
  Motion<S> transformed(const Motion<S>& motion) const;
  /// Returns null for null.
  std::shared_ptr<const Load> transformed(const std::shared_ptr<const Load>& load) const;
  /// Efforts of the motors, N·m or N.
  Vector6d transformed(const Vector6d& torques) const;
  /// Transforms machine, trajectory and load of the scenario; text and settings stay. Keeps the trajectory alive.
  Scenario transformed(const Scenario& scenario) const;
  /// Returns the same without the shift of the origin.
  FrameChange unshifted() const;

  // Convert answers from the new frame to the old one.
  Vector6d torquesBack(const Vector6d& torques) const;
  BodyMotions<double> back(const BodyMotions<double>& bodies) const;
  /// Rates and accelerations, but only displacements d and angles ψ and θ, because φ is measured from an axis that does
  /// not rotate with the frame.
  JointMotion back(const JointMotion& joints) const;
  Reactions back(const Reactions& reactions) const;
};

/// Converts T, or Ṫ·time, from the new frame to the old one; t_P = T q̇ of the driven coordinates.
Matrix6d shapingBack(const FrameChange& there, const Matrix6d& T);

/// A random rotation, shift by up to `size`, labels and units (no powers of two), reproducible from `seed`.
FrameChange randomFrameChange(unsigned seed, double size, const Manipulator& machine);

/// The frame with well-scaled numbers: an origin near the machine, and its own units of length, mass and time. All are
/// powers of two, so nothing is rounded. The origin stays for machines of metres near the base's origin.
FrameChange naturalFrameChange(const Scenario& scenario);

/// Wraps a subject created in SI for questions in the origin and units of `there`, which has no rotation and no other
/// labels. If the subject was created for the relocated scenario, the origin is zero and no digit is lost.
Subject transformed(const Subject& subject, const FrameChange& there);

Efforts effortsOf(const Manipulator& machine);

/// Returns the scenario with positions relative to `origin` (base points and trajectory), otherwise unchanged.
Scenario relocated(const Scenario& scenario, const Vector3d& origin);

}  // namespace ursula
