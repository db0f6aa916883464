#pragma once

// The paper's leg, universal–revolute–spherical: (1)–(19), (23), (26), (39)–(44). Internal.
//
//   AᵢBᵢ = −a + p + Qb                                               (3)
//   k = Q̂ᵀ AᵢBᵢ,  [AᵢBᵢ]_F = [0, k_y, r],  r = √(k_x² + k_z²) > 0    (13)
//   cos θ = (l² + s² − q²)/(2 l s)                                    (4a)
//   φ = atan2(−k_x, k_z)                                              (14a)
//   ψ = atan2(s sin θ, l − s cos θ) + atan2(√(q² − k_y²), k_y)        (14b)
//   θ̇ = q q̇ / (l s sin θ)                                            (4b)
//   φ̇ = h_x / (s sin(ψ+θ) − l sin ψ)                                  (15a)
//   ψ̇ = (h_y − s θ̇ sin(ψ+θ)) / (s sin(ψ+θ) − l sin ψ)                 (15b)
// and their derivatives (4c), (8), (18), (19). If a printed formula fails, the correct one stands here;
// docs/equations.md has the printed one.

#include "nocsolver/legs/plane.h"

namespace ursula::legs {

struct Urs {
  /// Throws OutOfReach and PointOnAxis.
  template <class S>
  static void displacement(const LegModel<S>& leg, int index, const S& t, LegState<S>& out) {
    using std::abs;
    using std::sqrt;
    const InAxes<S> k = inAxes(leg, out.AB);
    const S q2 = k.r * k.r + k.k_y * k.k_y, q = sqrt(q2);  // (paper, eq. 5)
    // Computes 1 ∓ cos θ without the cancellation of (4a) near a stretched or folded leg.
    const S two_ls = S(2) * leg.l * leg.s, difference = leg.l - leg.s, sum = leg.l + leg.s;
    const S one_minus = (q2 - difference * difference) / two_ls, one_plus = (sum * sum - q2) / two_ls;
    requireReach(one_minus >= S(0), index, t, q, S(abs(difference)));
    requireReach(one_plus >= S(0), index, t, q, sum);
    requireOffAxis(k.r, sum, index, t);
    const S cos_theta = (one_plus - one_minus) / S(2);  // (paper, eq. 4a)
    const S sin_theta = leg.knee * sqrt(one_minus * one_plus);
    // Both addends of (14b) are angles of triangles with hypotenuse q.
    const S sin_1 = leg.s * sin_theta / q, cos_1 = (leg.l - leg.s * cos_theta) / q, sin_2 = k.r / q, cos_2 = k.k_y / q;
    const S sin_psi = sin_1 * cos_2 + cos_1 * sin_2, cos_psi = cos_1 * cos_2 - sin_1 * sin_2;  // (paper, eq. 14b)
    out.sin_sum = sin_psi * cos_theta + cos_psi * sin_theta;
    out.cos_sum = cos_psi * cos_theta - sin_psi * sin_theta;
    const Plane<S> F = planeOf(leg, k);
    out.sine = {F.sine, sin_psi, sin_theta};
    out.cosine = {F.cosine, cos_psi, cos_theta};
    out.axis = {-leg.u, F.x, F.x};
    out.x = F.x;
    out.z = F.z;
    setLinks<S>(F.x, cos_psi * leg.u + sin_psi * F.z, F.x, -out.cos_sum * leg.u - out.sin_sum * F.z, out);
    out.margins = {abs(sin_theta), q / k.r};
  }

  /// First ends of the links relative to A: (39a,b) without the distances of the mass centres.
  template <class S>
  static void ends(const LegModel<S>& leg, LegState<S>& out) {
    out.O_1.setZero();
    out.O_2 = leg.l * out.e;
  }

  template <class S>
  static void requireRates(int index, const S& t, const LegState<S>& state) {
    requireRegular(state.margins.sine, "is stretched or folded, |sin theta|", index, t);
  }

  /// The distance of B from the axis, negated, with its rate.
  template <class S>
  struct Distance {
    S value, rate;
  };
  template <class S>
  static Distance<S> distance(const LegModel<S>& leg, const LegState<S>& at) {
    return {leg.s * at.sin_sum - leg.l * at.sine[1], eta(leg, at) - leg.l * at.rate(1) * at.cosine[1]};
  }
  template <class S>
  static S eta(const LegModel<S>& leg, const LegState<S>& at) {
    return leg.s * (at.rate(1) + at.rate(2)) * at.cos_sum;
  }

  /// A and n of φ, ψ, θ: (23), and (15b), (4b) for motors on other joints than the paper's.
  template <class S>
  static void rows(const LegModel<S>& leg, LegState<S>& out) {
    const S a_ii = leg.s * out.sin_sum - leg.l * out.sine[1], ls_sine = leg.l * leg.s * out.sine[2];
    const S lever = leg.s * out.sin_sum;
    out.row[0].A = a_ii;  // (paper, eq. 23)
    out.row[0].n = out.x;
    out.row[1].A = a_ii * ls_sine;
    out.row[1].n = ls_sine * leg.u - lever * out.AB;
    out.row[2].A = ls_sine;
    out.row[2].n = out.AB;
  }

  /// Their rates, (26). Needs rates.
  template <class S>
  static void rowRates(const LegModel<S>& leg, LegState<S>& out) {
    const Distance<S> a_ii = distance(leg, out);
    const S lever = leg.s * out.sin_sum, lever_dot = eta(leg, out);
    const S ls_sine = leg.l * leg.s * out.sine[2], ls_sine_dot = leg.l * leg.s * out.cosine[2] * out.rate(2);
    out.row[0].A_dot = a_ii.rate;            // (paper, eq. 26)
    out.row[0].n_dot = out.rate(0) * out.z;  // Q̂ᵢ Ωᵢ Q̂ᵢᵀ xᵢ with (12)
    out.row[1].A_dot = a_ii.rate * ls_sine + a_ii.value * ls_sine_dot;
    out.row[1].n_dot = ls_sine_dot * leg.u - lever_dot * out.AB - lever * out.v_B;
    out.row[2].A_dot = ls_sine_dot;
    out.row[2].n_dot = out.v_B;
  }

  /// φ̇, ψ̇, θ̇ for a velocity of Bᵢ; linear in it, as (48) requires.
  template <class S>
  static Vector3<S> rates(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& v_B) {
    const Vector3<S> h(at.x.dot(v_B), leg.u.dot(v_B), at.z.dot(v_B));  // (paper, eq. 11b)
    const S lever = leg.s * at.sin_sum, away = lever - leg.l * at.sine[1];
    const S theta = at.AB.dot(v_B) / (leg.l * leg.s * at.sine[2]);  // (paper, eqs. 4b, 6): q q̇ = AB · v_B
    const S phi = h.x() / away;                                     // (paper, eq. 15a)
    return {phi, (h.y() - theta * lever) / away, theta};            // (paper, eq. 15b)
  }

  /// φ̈, ψ̈, θ̈ for an acceleration of Bᵢ. The frame moves as `at` does; `rate`, `v_B` and `a_B` may be those of a
  /// column of T. So the same formulas give its rate.
  template <class S>
  static Vector3<S> accelerations(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
                                  const Vector3<S>& v_B, const Vector3<S>& a_B) {
    const S ls = leg.l * leg.s, q2 = at.AB.squaredNorm(), lever = leg.s * at.sin_sum;
    const S q_q_dot = at.AB.dot(at.v_B), q_dot2 = q_q_dot * at.AB.dot(v_B) / q2;
    // (Q̂ Ωᵢ Qᵢ)ᵀ v_B = −ωᵢ × h with ωᵢ = [0, −φ̇, 0] of (12).
    const S h_dot_x = at.x.dot(a_B) + at.rate(0) * at.z.dot(v_B), h_dot_y = leg.u.dot(a_B);  // (paper, eq. 18)
    const S q_q_ddot = at.v_B.dot(v_B) + a_B.dot(at.AB) - q_dot2;                            // (paper, eq. 8)
    const S theta =
        (q_dot2 + q_q_ddot - ls * at.rate(2) * rate(2) * at.cosine[2]) / (ls * at.sine[2]);  // (paper, eq. 4c)
    const Distance<S> away = distance(leg, at);
    const S phi = (h_dot_x - away.rate * rate(0)) / away.value;  // (paper, eq. 19a)
    const S psi =
        (h_dot_y - eta(leg, at) * rate(2) - theta * lever - away.rate * rate(1)) / away.value;  // (paper, eq. 19b)
    return {phi, psi, theta};
  }

  /// Both links, for rates and accelerations that may be those of a column of T; the frame moves as `at` does.
  template <bool with_rates = true, class S>
  static LinkMotions<S> links(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
                              const Vector3<S>& acceleration) {
    const S sum = rate(1) + rate(2), sum_now = at.rate(1) + at.rate(2), sum_dot = acceleration(1) + acceleration(2);
    const Direction<S> e = direction(at.cosine[1], at.sine[1], at.rate(1), rate(1), acceleration(1));
    const Direction<S> s = direction(S(-at.cos_sum), S(-at.sin_sum), sum_now, sum, sum_dot);
    const Direction<S> first = scaled(leg.rho, e), along = scaled(leg.sigma, s);  // (paper, eqs. 39a, 39b)
    Direction<S> second = scaled(leg.l, e);
    second = {second.at + along.at, second.now + along.now, second.dot + along.dot, second.ddot + along.ddot};
    const Turn<S> F{at.rate(0), rate(0), acceleration(0)};
    LinkMotions<S> out{inPlane<with_rates>(F, rate(1), acceleration(1), first),
                       inPlane<with_rates>(F, sum, sum_dot, second)};
    Matrix3<S> to_base;
    to_base << at.x, leg.u, at.z;
    for (LinkMotion<S>* link : {&out.proximal, &out.distal}) {
      link->omega = (to_base * link->omega).eval();
      link->c_dot = (to_base * link->c_dot).eval();
      if (!with_rates) continue;
      link->omega_dot = (to_base * link->omega_dot).eval();
      link->c_ddot = (to_base * link->c_ddot).eval();
    }
    return out;
  }

 private:
  /// [e]ᵢ or [s]ᵢ, or a multiple or sum of them, in Fᵢ. `now` is its rate in the actual motion, `dot` its rate for the
  /// requested rates, `ddot` the rate of `dot`.
  template <class S>
  struct Direction {
    Vector3<S> at, now, dot, ddot;
  };

  template <class S>
  static Direction<S> direction(const S& cosine, const S& sine, const S& now, const S& rate, const S& acceleration) {
    const Vector3<S> at(S(0), cosine, sine), across(S(0), -sine, cosine);
    return {at, now * across, rate * across, acceleration * across - now * rate * at};  // (paper, eqs. 42a, 42b)
  }
  template <class S>
  static Direction<S> scaled(const S& by, const Direction<S>& of) {
    return {by * of.at, by * of.now, by * of.dot, by * of.ddot};
  }

  /// φ̇ of the actual motion; the requested φ̇ and φ̈.
  template <class S>
  struct Turn {
    S now, rate, acceleration;
  };

  /// ω × v in Fᵢ with ω = [0, −φ̇, 0].
  template <class S>
  static Vector3<S> turned(const S& phi_dot, const Vector3<S>& v) {
    return {-phi_dot * v.z(), S(0), phi_dot * v.x()};  // (paper, eq. 12)
  }

  /// A link in Fᵢ that turns about x by χ, with its mass centre at `c`.
  template <bool with_rates, class S>
  static LinkMotion<S> inPlane(const Turn<S>& F, const S& chi_dot, const S& chi_ddot, const Direction<S>& c) {
    LinkMotion<S> out;
    out.omega = Vector3<S>(chi_dot, -F.rate, S(0));  // (paper, eq. 16)
    out.c_dot = turned(F.rate, c.at) + c.dot;        // (paper, eqs. 41a, 41b)
    if constexpr (!with_rates) return out;
    out.omega_dot = Vector3<S>(chi_ddot, -F.acceleration, F.now * chi_dot);  // (paper, eqs. 17a, 17b)
    out.c_ddot = turned(F.acceleration, c.at) + c.ddot;                      // (paper, eqs. 43a, 43b)
    out.c_ddot += turned(F.now, turned(F.rate, c.at));                       // Ω²
    out.c_ddot += turned(F.rate, c.now) + turned(F.now, c.dot);              // 2Ω
    return out;
  }
};

constexpr Urs classOf(std::integral_constant<LegKind, LegKind::URS>) { return {}; }

}  // namespace ursula::legs
