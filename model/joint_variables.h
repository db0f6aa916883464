#pragma once

#include <array>

#include "base/scalar.h"
#include "model/manipulator.h"

namespace ursula {

/// φ, ψ, θ, d of the legs, or their rates or accelerations; entry i is leg i. Coordinates that a leg lacks are zero.
template <class S>
struct JointVariables {
  Vector6<S> phi = Vector6<S>::Zero(), psi = phi, theta = phi, d = phi;

  Vector6<S>& of(Coordinate coordinate) {
    switch (coordinate) {
      case Coordinate::phi:
        return phi;
      case Coordinate::psi:
        return psi;
      case Coordinate::theta:
        return theta;
      case Coordinate::d:
        break;
    }
    return d;
  }
  const Vector6<S>& of(Coordinate coordinate) const { return const_cast<JointVariables&>(*this).of(coordinate); }

  /// Returns the driven coordinates in the order of the motors.
  Vector6<S> driven(const Motors& motors) const {
    Vector6<S> out;
    for (int k = 0; k < motor_count; ++k) {
      const Motor& motor = motors[k];
      out(k) = of(motor.coordinate)(motor.leg);
    }
    return out;
  }
};

/// Returns the norm of the difference between leg i's coordinates; displacements are divided by `length`.
double jointDistance(const JointVariables<double>& a, const JointVariables<double>& b, int i, double length);
/// Returns the largest over the legs; NaN is kept.
double jointDistance(const JointVariables<double>& a, const JointVariables<double>& b, double length);

/// Joint coordinates with rates and accelerations, in rad, rad/s, rad/s²; for d in m, m/s, m/s².
struct JointMotion {
  JointVariables<double> q, q_dot, q_ddot;
};

/// Pose, twist and twist rate of a body's mass centre, in B; R is G or H of (40), or Q.
template <class S>
struct BodyMotion {
  Vector3<S> c = Vector3<S>::Zero();                          ///< (39)
  Matrix3<S> R = Matrix3<S>::Zero();                          ///< (40)
  Vector6<S> twist = Vector6<S>::Zero(), twist_rate = twist;  ///< [ω; ċ] of (16), (41); [ω̇; c̈] of (17), (43)
};

/// Proximal links, distal links, platform: the order of (30a).
template <class S>
using BodyMotions = PerBody<BodyMotion<S>>;

/// Forces and moments that one leg's joints exert on the body nearer to the platform, at the joint's point; in B, N and
/// N·m. The moments include constraint moments, motor torque and friction.
struct LegReactions {
  Vector3d f_A = Vector3d::Zero(), n_A = Vector3d::Zero();  ///< base on proximal link, at A
  Vector3d f_R = Vector3d::Zero(), n_R = Vector3d::Zero();  ///< proximal on distal link, at R
  Vector3d f_B = Vector3d::Zero();                          ///< distal link on platform, at B
};

using Reactions = PerLeg<LegReactions>;

}  // namespace ursula
