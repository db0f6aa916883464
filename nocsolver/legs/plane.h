#pragma once

// Common parts of all kinds of legs: the plane of a leg and the motion of a link in it. Internal.

#include <Eigen/Geometry>
#include <cmath>

#include "nocsolver/legs/leg_model.h"
#include "nocsolver/legs/leg_state.h"
#include "nocsolver/legs/requirements.h"

namespace ursula::legs {

/// AB in F̂: k of (13), with r = √(k_x² + k_z²), the distance of B from the line through A along u.
template <class S>
struct InAxes {
  S k_x, k_y, k_z, r;
};

template <class S>
InAxes<S> inAxes(const LegModel<S>& leg, const Vector3<S>& AB) {
  using std::sqrt;
  InAxes<S> out{leg.x_hat.dot(AB), leg.u.dot(AB), leg.z_hat.dot(AB), S(0)};  // (paper, eq. 13)
  out.r = sqrt(out.k_x * out.k_x + out.k_z * out.k_z);
  return out;
}

/// Axes x and z of F̂R(α), from the sine and cosine of α.
template <class S>
struct Plane {
  S sine, cosine;
  Vector3<S> x, z;
};

template <class S>
Plane<S> planeAt(const LegModel<S>& leg, const S& sine, const S& cosine) {
  return {sine, cosine, cosine * leg.x_hat + sine * leg.z_hat,
          cosine * leg.z_hat - sine * leg.x_hat};  // (paper, eq. 1)
}

/// The plane of α = atan2(−k_x, k_z), which contains B at z = r > 0.
template <class S>
Plane<S> planeOf(const LegModel<S>& leg, const InAxes<S>& B) {
  return planeAt<S>(leg, -B.k_x / B.r, B.k_z / B.r);  // (paper, eq. 14a)
}

/// Sets the links' frames from their first and last axes.
template <class S>
void setLinks(const Vector3<S>& x_1, const Vector3<S>& e, const Vector3<S>& x_2, const Vector3<S>& along,
              LegState<S>& out) {
  out.x_1 = x_1;
  out.e = e;
  out.x_2 = x_2;
  out.along = along;
}

/// A link that turns about its point O. `arm` leads from O to the mass centre; `carried` is the arm's velocity in the
/// actual motion. A twist is bilinear in the rates of the frame and the requested rates. So the same lines give the
/// columns of T (48) and their rates.
template <bool with_rates, class S>
LinkMotion<S> turning(const Vector3<S>& omega, const Vector3<S>& omega_dot, const Vector3<S>& arm,
                      const Vector3<S>& carried) {
  if constexpr (!with_rates) return {omega, omega.cross(arm), Vector3<S>::Zero(), Vector3<S>::Zero()};
  LinkMotion<S> out{omega, omega.cross(arm), omega_dot, omega_dot.cross(arm)};
  out.c_ddot += omega.cross(carried);
  return out;
}

}  // namespace ursula::legs
