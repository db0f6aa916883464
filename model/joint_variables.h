#pragma once

#include <array>

#include "model/scalar.h"

namespace ursula {

/// φ, ψ, θ of the six legs, or their rates or accelerations; entry i is leg i.
template <class S>
struct JointVariables {
  Vector6<S> phi, psi, theta;
};

/// Joint coordinates with rates and accelerations, rad, rad/s, rad/s².
struct JointMotion {
  JointVariables<double> q, q_dot, q_ddot;
};

/// Pose, twist and twist rate of a body's mass centre, in B; R is G or H of (40), or Q.
template <class S>
struct BodyMotion {
  Vector3<S> c;                  ///< (39)
  Matrix3<S> R;                  ///< (40)
  Vector6<S> twist, twist_rate;  ///< [ω; ċ] of (16), (41); [ω̇; c̈] of (17), (43)
};

/// Proximal links, distal links, platform: the order of (30a).
template <class S>
using BodyMotions = std::array<BodyMotion<S>, body_count>;

}  // namespace ursula
