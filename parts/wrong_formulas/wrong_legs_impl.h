#pragma once

// What wrong formulas change in a leg: each function corrects the right result for the errors that are set. Included by
// wrong_noc_impl.h.

#include <cmath>

#include "nocsolver/legs/leg_of.h"
#include "parts/wrong_formulas/formula_errors.h"

namespace ursula::wrong {

/// (−φ̇ u) × v.
template <class S>
Vector3<S> turned(const LegModel<S>& leg, const S& phi_dot, const Vector3<S>& v) {
  return -phi_dot * leg.u.cross(v);
}

/// (14a), (14b) as printed, from the right displacement.
template <class S>
void placeUrs(const LegModel<S>& leg, const WithFormulaErrors& errors, LegState<S>& out) {
  using std::sqrt;
  const legs::InAxes<S> k = legs::inAxes(leg, out.AB);
  const S &sin_theta = out.sine[2], &cos_theta = out.cosine[2];
  const S q = sqrt(S(k.r * k.r + k.k_y * k.k_y)), y = errors.has(FormulaError::eq14b) ? S(-k.k_y) : k.k_y;
  const S sin_1 = leg.s * sin_theta / q, cos_1 = (leg.l - leg.s * cos_theta) / q, sin_2 = k.r / q, cos_2 = y / q;
  const S sin_psi = sin_1 * cos_2 + cos_1 * sin_2, cos_psi = cos_1 * cos_2 - sin_1 * sin_2;
  out.sin_sum = sin_psi * cos_theta + cos_psi * sin_theta;
  out.cos_sum = cos_psi * cos_theta - sin_psi * sin_theta;
  legs::Plane<S> F = legs::planeOf(leg, k);
  if (errors.has(FormulaError::eq14a) && F.sine < S(0)) F = legs::planeAt<S>(leg, -F.sine, -F.cosine);
  out.sine = {F.sine, sin_psi, sin_theta};
  out.cosine = {F.cosine, cos_psi, cos_theta};
  out.axis = {-leg.u, F.x, F.x};
  out.x = F.x;
  out.z = F.z;
  legs::setLinks<S>(F.x, cos_psi * leg.u + sin_psi * F.z, F.x, -out.cos_sum * leg.u - out.sin_sum * F.z, out);
}

/// (15a), (15b) as printed.
template <class S>
void rateUrs(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& v_B, const WithFormulaErrors& errors,
             Vector3<S>& rate) {
  using std::atan2;
  const S lever = leg.s * at.sin_sum, away = lever - leg.l * at.sine[1];
  if (errors.has(FormulaError::eq15a)) rate(0) = at.x.dot(v_B) / lever;
  if (errors.has(FormulaError::eq15b)) rate(1) = (leg.u.dot(v_B) - atan2(at.sine[2], at.cosine[2]) * lever) / away;
}

/// (4c), (19a), (19b) as printed.
template <class S>
void accelerateUrs(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& v_B,
                   const Vector3<S>& a_B, const WithFormulaErrors& errors, Vector3<S>& out) {
  using std::atan2;
  const S lever = leg.s * at.sin_sum, q2 = at.AB.squaredNorm(), eta = legs::Urs::eta(leg, at);
  const auto away = legs::Urs::distance(leg, at);
  if (errors.has(FormulaError::eq4c)) {
    const S change = (q2 - at.AB.dot(at.v_B) * at.AB.dot(v_B) / q2) / (leg.l * leg.s * at.sine[2]);
    out(2) += change;
    out(1) -= change * lever / away.value;
  }
  if (errors.has(FormulaError::eq19a))
    out(0) = (at.x.dot(a_B) + at.rate(0) * at.z.dot(v_B) - eta * atan2(at.sine[0], at.cosine[0])) / lever;
  if (errors.has(FormulaError::eq19b)) out(1) += away.rate * (rate(1) - S(1)) / away.value;
}

/// The rates in a link's plane of the way from A to its mass centre, in B: in the motion, for the requested rates, and
/// the rate of that.
template <class S>
struct InPlane {
  Vector3<S> at, now, dot, ddot;
};

template <class S>
InPlane<S> inPlane(const LegState<S>& at, const Vector3<S>& along, const S& size, const S& now, const S& rate,
                   const S& acceleration) {
  const Vector3<S> across = size * at.x.cross(along);
  return {size * along, now * across, rate * across, acceleration * across - now * rate * size * along};
}

/// (16), (17), (41b), (43) with their errors for a link of the paper's leg.
template <class S>
void moveUrs(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
             const InPlane<S>& c, const WithFormulaErrors& errors, bool with_rates, LinkMotion<S>& link) {
  if (errors.has(FormulaError::eq16)) link.omega += S(2) * rate(0) * leg.u;
  if (!with_rates) return;
  if (errors.has(FormulaError::eq17)) link.omega_dot += S(2) * acceleration(0) * leg.u;
  if (errors.has(FormulaError::drop_centrifugal))
    link.c_ddot -= turned<S>(leg, at.rate(0), turned<S>(leg, rate(0), c.at));
  if (errors.has(FormulaError::drop_coriolis))
    link.c_ddot -= turned<S>(leg, rate(0), c.now) + turned<S>(leg, at.rate(0), c.dot);
}

/// (43b) with its printed errors: (Ω̇ᵢ + Ωᵢ²) acts on w, and as printed σ is added to each component of [s].
template <class S>
void misprint43b(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                 const InPlane<S>& d, const WithFormulaErrors& errors, Vector3<S>& d_ddot) {
  const bool sigma = errors.has(FormulaError::eq43b_sigma), square = errors.has(FormulaError::eq43b_omega_dot);
  if (sigma || square) {
    Vector3<S> w = d.at;
    if (sigma) w = leg.l * at.e + at.along + leg.sigma * (at.x + leg.u + at.z);
    const S first = square ? acceleration(0) : rate(0), second = square ? acceleration(0) : at.rate(0);
    d_ddot += turned<S>(leg, acceleration(0), w - d.at) + turned<S>(leg, second, turned<S>(leg, first, w)) -
              turned<S>(leg, at.rate(0), turned<S>(leg, rate(0), d.at));
  }
  if (errors.has(FormulaError::eq43b_doubled)) d_ddot += d.ddot;
}

template <class S>
void linksOf(legs::Urs, const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
             const Vector3<S>& acceleration, const WithFormulaErrors& errors, bool with_rates, LinkMotions<S>& out) {
  const S sum = rate(1) + rate(2), sum_now = at.rate(1) + at.rate(2), sum_dot = acceleration(1) + acceleration(2);
  const auto along_e = [&](const S& size) { return inPlane<S>(at, at.e, size, at.rate(1), rate(1), acceleration(1)); };
  const InPlane<S> elbow = along_e(leg.l), s = inPlane<S>(at, at.along, leg.sigma, sum_now, sum, sum_dot);
  InPlane<S> d = {elbow.at + s.at, elbow.now + s.now, elbow.dot + s.dot, elbow.ddot + s.ddot};
  if (errors.has(FormulaError::drop_link_coupling)) {
    d = {elbow.at + s.at, s.now, s.dot, s.ddot};
    out.distal.c_dot -= elbow.dot;
    if (with_rates)
      out.distal.c_ddot -= elbow.ddot + turned<S>(leg, rate(0), elbow.now) + turned<S>(leg, at.rate(0), elbow.dot);
  }
  moveUrs(leg, at, rate, acceleration, along_e(leg.rho), errors, with_rates, out.proximal);
  moveUrs(leg, at, rate, acceleration, d, errors, with_rates, out.distal);
  if (with_rates) misprint43b(leg, at, rate, acceleration, d, errors, out.distal.c_ddot);
}

/// Takes a part of ω̇ from a link that turns about a point at `arm` from its mass centre.
template <class S>
void takeTurn(const Vector3<S>& part, const Vector3<S>& arm, LinkMotion<S>& link) {
  link.omega_dot -= part;
  link.c_ddot -= part.cross(arm);
}

template <class S>
void linksOf(legs::Ups, const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
             const Vector3<S>& acceleration, const WithFormulaErrors& errors, bool with_rates, LinkMotions<S>& out) {
  const Vector3<S> now = -at.rate(0) * leg.u + at.rate(1) * at.x, omega = -rate(0) * leg.u + rate(1) * at.x;
  const Vector3<S> arm = at.O_2 + at.arm_2, carried = rate(2) * now.cross(at.e),
                   turning = at.rate(2) * omega.cross(at.e);
  const bool coriolis = errors.has(FormulaError::drop_coriolis);
  if (errors.has(FormulaError::drop_link_coupling)) out.distal.c_dot -= rate(2) * at.e;
  if (!with_rates) return;
  if (errors.has(FormulaError::drop_link_coupling)) out.distal.c_ddot -= acceleration(2) * at.e + carried + turning;
  if (errors.has(FormulaError::drop_centrifugal)) {
    out.proximal.c_ddot -= omega.cross(now.cross(at.arm_1));
    out.distal.c_ddot -= omega.cross(now.cross(arm));
  }
  if (coriolis) {
    const Vector3<S> part = (rate(1) * at.rate(0)) * at.z;
    takeTurn<S>(part, at.arm_1, out.proximal);
    takeTurn<S>(part, arm, out.distal);
    out.distal.c_ddot -= carried + turning;
  }
  if (errors.has(FormulaError::half_coriolis) && !coriolis) out.distal.c_ddot -= turning;
}

template <class S>
void linksOf(legs::Rus, const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
             const Vector3<S>& acceleration, const WithFormulaErrors& errors, bool with_rates, LinkMotions<S>& out) {
  const Vector3<S> now_1 = -at.rate(0) * leg.u, now_2 = now_1 - at.rate(1) * leg.u - at.rate(2) * at.x_2;
  const Vector3<S> omega_1 = -rate(0) * leg.u, omega_2 = omega_1 - rate(1) * leg.u - rate(2) * at.x_2;
  const Vector3<S> omega_1_dot = -acceleration(0) * leg.u, of_elbow = omega_1.cross(now_1.cross(at.O_2));
  const bool coupled = !errors.has(FormulaError::drop_link_coupling);
  if (!coupled) out.distal.c_dot -= omega_1.cross(at.O_2);
  if (!with_rates) return;
  if (!coupled) out.distal.c_ddot -= omega_1_dot.cross(at.O_2) + of_elbow;
  if (errors.has(FormulaError::drop_centrifugal)) {
    out.proximal.c_ddot -= omega_1.cross(now_1.cross(at.arm_1));
    out.distal.c_ddot -= omega_2.cross(now_2.cross(at.arm_2));
    if (coupled) out.distal.c_ddot -= of_elbow;
  }
  if (errors.has(FormulaError::drop_coriolis))
    takeTurn<S>(-(rate(2) * (at.rate(0) + at.rate(1))) * at.x_2.cross(leg.u), at.arm_2, out.distal);
}

template <class S>
void linksOf(legs::Pus, const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
             const Vector3<S>& acceleration, const WithFormulaErrors& errors, bool with_rates, LinkMotions<S>& out) {
  const Vector3<S> now = -at.rate(1) * leg.u + at.rate(2) * at.x, omega = -rate(1) * leg.u + rate(2) * at.x;
  if (errors.has(FormulaError::drop_link_coupling)) out.distal.c_dot -= rate(0) * leg.u;
  if (!with_rates) return;
  if (errors.has(FormulaError::drop_link_coupling)) out.distal.c_ddot -= acceleration(0) * leg.u;
  if (errors.has(FormulaError::drop_centrifugal)) out.distal.c_ddot -= omega.cross(now.cross(at.arm_2));
  if (errors.has(FormulaError::drop_coriolis)) takeTurn<S>((rate(2) * at.rate(1)) * at.z, at.arm_2, out.distal);
}

}  // namespace ursula::wrong
