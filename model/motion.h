#pragma once

#include "base/scalar.h"

namespace ursula {

/// Pose, twist and twist rate of the platform at one instant; all in B, SI.
template <class S>
struct Motion {
  S t{0};
  Vector3<S> p = Vector3<S>::Zero();          ///< position of P
  Matrix3<S> Q = Matrix3<S>::Identity();      ///< orientation of M in B
  Vector3<S> omega = Vector3<S>::Zero();      ///< angular velocity ω of (7)
  Vector3<S> p_dot = Vector3<S>::Zero();      ///< velocity of P
  Vector3<S> omega_dot = Vector3<S>::Zero();  ///< angular acceleration
  Vector3<S> p_ddot = Vector3<S>::Zero();     ///< acceleration of P
};

/// Returns whether pose, twist and twist rate are equal, at whatever instants.
inline bool sameState(const Motion<double>& a, const Motion<double>& b) {
  return a.p == b.p && a.Q == b.Q && a.omega == b.omega && a.p_dot == b.p_dot && a.omega_dot == b.omega_dot &&
         a.p_ddot == b.p_ddot;
}

}  // namespace ursula
