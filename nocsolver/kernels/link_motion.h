#pragma once

// Twists of the two links of a leg and their rates, in the axes of Fᵢ. Internal.
//
// In Fᵢ, which turns with ωᵢ = [0, −φ̇, 0] (12), a point of the leg is [0, y, z] and a link's own rate is about x, so
//   ω  = [χ̇, −φ̇, 0]                          with χ̇ = ψ̇ (proximal), ψ̇ + θ̇ (distal)           (16)
//   ω̇  = [χ̈, −φ̈, φ̇χ̇]                                                                         (17)
//   ċ  = [−φ̇ z, ẏ, ż]                                                                         (41)
//   c̈  = [−φ̈ z − 2φ̇ ż, ÿ, z̈ − φ̇² z]                                                           (43)
// They are written bilinear in the rates that move the frame and the rates whose twist is wanted (one of the two φ̇ in
// 2φ̇ż is the frame's), so that the columns of T (48) and of Ṫ come out of the same lines.

#include "nocsolver/leg_state.h"
#include "nocsolver/paper_model.h"
#include "nocsolver/reading.h"

namespace ursula::kernel {

/// A point [0, y, z] of the leg with its derivatives for rates of the joints.
template <class S>
struct PlanarPoint {
  S y{0}, z{0}, y_dot{0}, z_dot{0}, y_ddot{0}, z_ddot{0};
};

/// length·[e] of the proximal link, or of the distal one (then sine and cosine are those of −s), turning about x.
/// (42a,b) and their derivative; `frame_rate` is the actual rate of the angle, `rate` the one whose twist is wanted.
template <class S>
PlanarPoint<S> planarPoint(const S& length, const S& cosine, const S& sine, const S& frame_rate, const S& rate,
                           const S& acceleration) {
  PlanarPoint<S> point;
  point.y = length * cosine;
  point.z = length * sine;
  point.y_dot = -point.z * rate;  // (paper, eq. 42)
  point.z_dot = point.y * rate;
  point.y_ddot = -point.z * acceleration - point.y * frame_rate * rate;
  point.z_ddot = point.y * acceleration - point.z * frame_rate * rate;
  return point;
}

template <class S, class R>
Vector3<S> linkAngularVelocity(const S& about_x, const S& phi_dot, const R& reading) {
  return {about_x, reading.has(Slip::eq16) ? phi_dot : S(-phi_dot), S(0)};  // (paper, eq. 16)
}

template <class S, class R>
Vector3<S> linkAngularAcceleration(const S& about_x, const S& about_x_dot, const S& frame_phi_dot, const S& phi_ddot,
                                   const R& reading) {
  return {about_x_dot, reading.has(Slip::eq17) ? phi_ddot : S(-phi_ddot), frame_phi_dot * about_x};  // (paper, eq. 17)
}

/// Velocity of a point of the leg, in Fᵢ.
template <class S>
Vector3<S> pointVelocity(const PlanarPoint<S>& point, const S& phi_dot) {
  return {-phi_dot * point.z, point.y_dot, point.z_dot};  // (paper, eq. 41)
}

/// Acceleration of a point of the leg, in Fᵢ. `frame_z_dot` is ż at the actual rates.
template <class S, class R>
Vector3<S> pointAcceleration(const PlanarPoint<S>& point, const S& frame_phi_dot, const S& frame_z_dot,
                             const S& phi_dot, const S& phi_ddot, const R& reading) {
  Vector3<S> acceleration(-phi_ddot * point.z, point.y_ddot, point.z_ddot);  // (paper, eq. 43)
  if (!reading.has(Slip::drop_coriolis)) acceleration.x() -= phi_dot * frame_z_dot + frame_phi_dot * point.z_dot;
  if (!reading.has(Slip::drop_centrifugal)) acceleration.z() -= frame_phi_dot * phi_dot * point.z;
  return acceleration;
}

/// (43b) with the slips that only it has; the rest of (43b) is pointAcceleration.
template <class S, class R>
void readSlipsOf43b(const LegModel<S>& leg, const LegState<S>& state, const PlanarPoint<S>& d, const R& reading,
                    Vector3<S>& d_ddot) {
  // What (Ω̇ᵢ + Ωᵢ²) acts on, as it holds [0, d_y, d_z]; as printed σ is added to each component of [s].
  const S phi_dot = state.rate.phi, phi_ddot = state.acceleration.phi;
  const bool printed_sigma = reading.has(Slip::eq43b_sigma);
  const S w_x = printed_sigma ? leg.sigma : S(0);
  const S w_z = printed_sigma ? S(leg.l * state.sin_psi + leg.sigma - state.sin_sum) : d.z;
  const S squared = reading.has(Slip::eq43b_omega_dot) ? S(phi_ddot * phi_ddot) : S(phi_dot * phi_dot);
  if (printed_sigma || reading.has(Slip::eq43b_omega_dot)) {
    d_ddot.x() += -phi_ddot * (w_z - d.z) - squared * w_x;
    d_ddot.z() += phi_ddot * w_x - squared * w_z + phi_dot * phi_dot * d.z;
  }
  if (reading.has(Slip::eq43b_doubled)) d_ddot += Vector3<S>(S(0), d.y_ddot, d.z_ddot);
}

/// Both links of a leg. `rate` and `acceleration` are those whose twist and twist rate are wanted; the frame moves with
/// the actual rates of `state`.
template <class S, class R>
void linkMotions(const LegModel<S>& leg, const LegState<S>& state, const JointTriple<S>& rate,
                 const JointTriple<S>& acceleration, const R& reading, LinkMotion<S>& proximal, LinkMotion<S>& distal) {
  const S frame_sum = state.rate.psi + state.rate.theta;
  const S sum_rate = rate.psi + rate.theta, sum_acceleration = acceleration.psi + acceleration.theta;
  const PlanarPoint<S> c =
      planarPoint(leg.rho, state.cos_psi, state.sin_psi, state.rate.psi, rate.psi, acceleration.psi);
  const PlanarPoint<S> knee =
      planarPoint(leg.l, state.cos_psi, state.sin_psi, state.rate.psi, rate.psi, acceleration.psi);
  PlanarPoint<S> d =
      planarPoint(leg.sigma, S(-state.cos_sum), S(-state.sin_sum), frame_sum, sum_rate, sum_acceleration);
  S d_frame_z_dot = d.y * frame_sum;
  d.y += knee.y;  // (paper, eq. 39b)
  d.z += knee.z;
  if (!reading.has(Slip::drop_link_coupling)) {
    d.y_dot += knee.y_dot;
    d.z_dot += knee.z_dot;
    d.y_ddot += knee.y_ddot;
    d.z_ddot += knee.z_ddot;
    d_frame_z_dot += knee.y * state.rate.psi;
  }

  proximal.c = Vector3<S>(S(0), c.y, c.z);  // (paper, eq. 39a)
  distal.c = Vector3<S>(S(0), d.y, d.z);
  proximal.omega = linkAngularVelocity(rate.psi, rate.phi, reading);
  distal.omega = linkAngularVelocity(sum_rate, rate.phi, reading);
  proximal.c_dot = pointVelocity(c, rate.phi);
  distal.c_dot = pointVelocity(d, rate.phi);
  proximal.omega_dot = linkAngularAcceleration(rate.psi, acceleration.psi, state.rate.phi, acceleration.phi, reading);
  distal.omega_dot = linkAngularAcceleration(sum_rate, sum_acceleration, state.rate.phi, acceleration.phi, reading);
  proximal.c_ddot = pointAcceleration(c, state.rate.phi, S(c.y * state.rate.psi), rate.phi, acceleration.phi, reading);
  distal.c_ddot = pointAcceleration(d, state.rate.phi, d_frame_z_dot, rate.phi, acceleration.phi, reading);
  readSlipsOf43b(leg, state, d, reading, distal.c_ddot);
}

}  // namespace ursula::kernel
