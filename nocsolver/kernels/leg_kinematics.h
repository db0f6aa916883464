#pragma once

// Inverse kinematics of one leg, the algorithm of the paper's Fig. 4. Internal: included by the solver's sources only.
//
//   AᵢBᵢ = −a + p + Qb                                               (3)
//   k = Q̂ᵀ AᵢBᵢ,  [AᵢBᵢ]_F = [0, k_y, r],  r = √(k_x² + k_z²) > 0    (13)
//   cos θ = (l² + s² − q²)/(2 l s)                                    (4a)
//   φ = atan2(−k_x, k_z)                                              (14a)
//   ψ = atan2(s sin θ, l − s cos θ) + atan2(√(q² − k_y²), k_y)        (14b)
//   θ̇ = q q̇ / (l s sin θ)                                            (4b)
//   φ̇ = h_x / (s sin(ψ+θ) − l sin ψ)                                  (15a)
//   ψ̇ = (h_y − s θ̇ sin(ψ+θ)) / (s sin(ψ+θ) − l sin ψ)                 (15b)
// and their derivatives (4c), (8), (18), (19). Where a formula fails as printed the one that holds stands here; the
// printed one is read where its slip is set.

#include <Eigen/Geometry>
#include <cmath>

#include "model/motion.h"
#include "nocsolver/errors.h"
#include "nocsolver/leg_state.h"
#include "nocsolver/paper_model.h"
#include "nocsolver/reading.h"

namespace ursula::kernel {

template <class S>
[[noreturn]] void throwOutOfReach(const LegModel<S>& leg, int index, const S& t, const S& q, bool too_far) {
  using std::abs;
  const S bound = too_far ? S(leg.l + leg.s) : S(abs(leg.l - leg.s));
  throw OutOfReach("is out of reach", index, static_cast<double>(t), static_cast<double>(q), static_cast<double>(bound),
                   " m");
}

/// r, q and θ from AB. Throws OutOfReach and PointOnAxis.
template <class S>
void legTriangle(const LegModel<S>& leg, int index, const S& t, const S& k_x, const S& k_z, LegState<S>& out) {
  using std::sqrt;
  const S r2 = k_x * k_x + k_z * k_z;
  const S q2 = r2 + out.k_y * out.k_y;  // (paper, eq. 5)
  out.r = sqrt(r2);
  out.q = sqrt(q2);
  // 1 ∓ cos θ without the cancellation of (4a) near a stretched or folded leg.
  const S two_ls = S(2) * leg.l * leg.s;
  const S difference = leg.l - leg.s, sum = leg.l + leg.s;
  const S one_minus = (q2 - difference * difference) / two_ls, one_plus = (sum * sum - q2) / two_ls;
  if (!(one_minus >= S(0)) || !(one_plus >= S(0))) throwOutOfReach(leg, index, t, out.q, !(one_plus >= S(0)));
  // Below √eps the direction of r is made of rounding errors.
  const S axis_bound = sqrt(Eigen::NumTraits<S>::epsilon()) * sum;
  if (!(out.r > axis_bound))
    throw PointOnAxis("has B on its axis", index, static_cast<double>(t), static_cast<double>(out.r),
                      static_cast<double>(axis_bound), " m");
  out.cos_theta = (one_plus - one_minus) / S(2);  // (paper, eq. 4a)
  out.sin_theta = leg.knee * sqrt(one_minus * one_plus);
}

/// φ and ψ, as sines and cosines, with the axes of Fᵢ.
template <class S, class R>
void legFrame(const LegModel<S>& leg, const S& k_x, const S& k_z, const R& reading, LegState<S>& out) {
  out.sin_phi = -k_x / out.r;  // (paper, eq. 14a)
  out.cos_phi = k_z / out.r;
  if (reading.has(Slip::eq14a) && out.sin_phi < S(0)) {
    out.sin_phi = -out.sin_phi;
    out.cos_phi = -out.cos_phi;
  }
  // Both addends of (14b) are angles of triangles with hypotenuse q.
  const S y = reading.has(Slip::eq14b) ? S(-out.k_y) : out.k_y;
  const S sin_1 = leg.s * out.sin_theta / out.q, cos_1 = (leg.l - leg.s * out.cos_theta) / out.q;
  const S sin_2 = out.r / out.q, cos_2 = y / out.q;
  out.sin_psi = sin_1 * cos_2 + cos_1 * sin_2;  // (paper, eq. 14b)
  out.cos_psi = cos_1 * cos_2 - sin_1 * sin_2;
  out.sin_sum = out.sin_psi * out.cos_theta + out.cos_psi * out.sin_theta;
  out.cos_sum = out.cos_psi * out.cos_theta - out.sin_psi * out.sin_theta;

  out.x = out.cos_phi * leg.x_hat + out.sin_phi * leg.z_hat;  // (paper, eq. 1)
  out.z = out.cos_phi * leg.z_hat - out.sin_phi * leg.x_hat;
  const S a_ii = leg.s * out.sin_sum - leg.l * out.sin_psi;
  out.a_ii = reading.has(Slip::eq23) ? S(leg.s * out.sin_sum) : a_ii;  // (paper, eq. 23)
}

/// Position and orientation of the leg. Throws OutOfReach and PointOnAxis.
template <class S, class R>
void legDisplacement(const LegModel<S>& leg, int index, const Motion<S>& motion, const R& reading, LegState<S>& out) {
  out.Qb.noalias() = motion.Q * leg.b;
  out.AB = (motion.p - leg.a) + out.Qb;  // (paper, eq. 3), with nothing lost far from the base's origin
  if (reading.has(Slip::eq5)) out.AB = motion.p + out.Qb + leg.a;
  const S k_x = leg.x_hat.dot(out.AB), k_z = leg.z_hat.dot(out.AB);  // (paper, eq. 13)
  out.k_y = leg.y_hat.dot(out.AB);
  legTriangle(leg, index, motion.t, k_x, k_z, out);
  legFrame(leg, k_x, k_z, reading, out);
}

/// Throws StretchedLeg: below √eps, sin θ has no correct digit left.
template <class S>
void requireBentKnee(const LegState<S>& state, int index, const S& t) {
  using std::abs;
  using std::sqrt;
  const S bound = sqrt(Eigen::NumTraits<S>::epsilon());
  if (!(abs(state.sin_theta) > bound))
    throw StretchedLeg("is stretched or folded, |sin theta|", index, static_cast<double>(t),
                       static_cast<double>(abs(state.sin_theta)), static_cast<double>(bound), "");
}

/// Joint rates of a leg for a velocity of Bᵢ with components h in Fᵢ; linear in h, as (48) needs it.
template <class S, class R>
JointTriple<S> legRates(const LegModel<S>& leg, const LegState<S>& state, const Vector3<S>& h, const R& reading) {
  JointTriple<S> rate;
  const S distance = leg.s * state.sin_sum - leg.l * state.sin_psi;
  const S q_q_dot = h.y() * state.k_y + h.z() * state.r;                                // (paper, eq. 6)
  rate.theta = q_q_dot / (leg.l * leg.s * state.sin_theta);                             // (paper, eq. 4b)
  rate.phi = h.x() / (reading.has(Slip::eq15a) ? S(leg.s * state.sin_sum) : distance);  // (paper, eq. 15a)
  S theta_rate = rate.theta;
  if (reading.has(Slip::eq15b)) {
    using std::atan2;
    theta_rate = atan2(state.sin_theta, state.cos_theta);
  }
  rate.psi = (h.y() - leg.s * theta_rate * state.sin_sum) / distance;  // (paper, eq. 15b)
  return rate;
}

/// Velocity of Bᵢ and the rates of the joints.
template <class S, class R>
void legVelocity(const LegModel<S>& leg, const Motion<S>& motion, const R& reading, LegState<S>& out) {
  out.v_B = motion.p_dot + motion.omega.cross(out.Qb);
  out.h = Vector3<S>(out.x.dot(out.v_B), leg.y_hat.dot(out.v_B), out.z.dot(out.v_B));  // (paper, eq. 11b)
  out.q_dot = out.AB.dot(out.v_B) / out.q;                                             // (paper, eq. 6)
  out.rate = legRates(leg, out, out.h, reading);
  out.eta = leg.s * (out.rate.psi + out.rate.theta) * out.cos_sum;
  const S a_ii_dot = out.eta - leg.l * out.rate.psi * out.cos_psi;
  out.a_ii_dot = reading.has(Slip::eq26_a_dot) ? out.eta : a_ii_dot;  // (paper, eq. 26)
}

/// Accelerations of the joints. The rates that move the frame are the actual ones of `state`; `rate`, `h_dot` and
/// `q_q_dot_dot` = d(q q̇)/dt may be those of a column of T, so that the same formulas give Ṫ.
template <class S, class R>
JointTriple<S> legAccelerations(const LegModel<S>& leg, const LegState<S>& state, const JointTriple<S>& rate,
                                const Vector3<S>& h_dot, const S& q_q_dot_dot, const R& reading) {
  JointTriple<S> acceleration;
  const S ls = leg.l * leg.s;
  const S distance = leg.s * state.sin_sum - leg.l * state.sin_psi;
  const S distance_dot = state.eta - leg.l * state.rate.psi * state.cos_psi;
  acceleration.theta =
      (q_q_dot_dot - ls * state.rate.theta * rate.theta * state.cos_theta) / (ls * state.sin_theta);  // (paper, eq. 4c)
  acceleration.phi = (h_dot.x() - distance_dot * rate.phi) / distance;  // (paper, eq. 19a)
  if (reading.has(Slip::eq19a)) {
    using std::atan2;
    acceleration.phi = (h_dot.x() - state.eta * atan2(state.sin_phi, state.cos_phi)) / (leg.s * state.sin_sum);
  }
  const S factor = reading.has(Slip::eq19b) ? S(1) : rate.psi;
  acceleration.psi =
      (h_dot.y() - state.eta * rate.theta - leg.s * acceleration.theta * state.sin_sum - distance_dot * factor) /
      distance;  // (paper, eq. 19b)
  return acceleration;
}

/// Acceleration of Bᵢ and of the joints.
template <class S, class R>
void legAcceleration(const LegModel<S>& leg, const Motion<S>& motion, const R& reading, LegState<S>& out) {
  const Vector3<S> a_B =
      motion.p_ddot + motion.omega_dot.cross(out.Qb) + motion.omega.cross(motion.omega.cross(out.Qb));
  // (Q̂ Ωᵢ Qᵢ)ᵀ v_B = −ωᵢ × h with ωᵢ = [0, −φ̇, 0] of (12).
  out.h_dot = Vector3<S>(out.x.dot(a_B) + out.rate.phi * out.h.z(), leg.y_hat.dot(a_B),
                         out.z.dot(a_B) - out.rate.phi * out.h.x());  // (paper, eq. 18)
  const S q_dot2 = out.q_dot * out.q_dot;
  out.q_ddot = (out.v_B.squaredNorm() + a_B.dot(out.AB) - q_dot2) / out.q;  // (paper, eq. 8)
  const S first = reading.has(Slip::eq4c) ? S(out.q * out.q) : q_dot2;
  out.acceleration = legAccelerations(leg, out, out.rate, out.h_dot, S(first + out.q * out.q_ddot), reading);
}

}  // namespace ursula::kernel
