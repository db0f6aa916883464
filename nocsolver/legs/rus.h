#pragma once

// Crank and rod (Hexa), revolute–universal–spherical. Internal.
//
//   AB = l z + s⃗,  s⃗ = s (sin θ u + cos θ z₂),  z of F = F̂R(φ), z₂ of F₂ = F̂R(φ + ψ)
//   sin θ = k_y / s;  across u a plane linkage of l and c = s cos θ:
//   cos ψ = (r² − l² − c²)/(2 l c),  φ = atan2(−k_x, k_z) − atan2(c sin ψ, l + c cos ψ)
//   v_B = −φ̇ l x − (φ̇ + ψ̇) c x₂ + θ̇ (c u − k_y z₂)                                        (a)
// (a) times s⃗ isolates φ̇, times u isolates θ̇; times z, with θ̇ inserted, isolates φ̇ + ψ̇.
// The crank turns with ω = −φ̇ u, the rod with ω = −(φ̇ + ψ̇) u − θ̇ x₂.                       (b)

#include "nocsolver/legs/by_rows.h"

namespace ursula::legs {

struct Rus : ByRows {
  /// Throws OutOfReach and PointOnAxis.
  template <class S>
  static void displacement(const LegModel<S>& leg, int index, const S& t, LegState<S>& out) {
    using std::abs;
    using std::sqrt;
    const InAxes<S> B = inAxes(leg, out.AB);
    const S c2 = (leg.s - B.k_y) * (leg.s + B.k_y);
    requireReach(c2 > S(0), index, t, S(abs(B.k_y)), leg.s);
    const S c = sqrt(c2), sin_theta = B.k_y / leg.s, cos_theta = c / leg.s;
    const S two_lc = S(2) * leg.l * c, difference = leg.l - c, sum = leg.l + c;
    const S one_plus = (B.r * B.r - difference * difference) / two_lc, one_minus = (sum * sum - B.r * B.r) / two_lc;
    requireReach(one_minus >= S(0), index, t, B.r, sum);
    requireReach(one_plus >= S(0), index, t, B.r, S(abs(difference)));
    requireOffAxis(B.r, S(leg.l + leg.s), index, t);
    const S cos_psi = (one_plus - one_minus) / S(2), sin_psi = leg.knee * sqrt(one_minus * one_plus);
    const S sin_1 = c * sin_psi / B.r, cos_1 = (leg.l + c * cos_psi) / B.r;
    const S sin_2 = -B.k_x / B.r, cos_2 = B.k_z / B.r;
    const Plane<S> F = planeAt<S>(leg, sin_2 * cos_1 - cos_2 * sin_1, cos_2 * cos_1 + sin_2 * sin_1);
    const Vector3<S> x_2 = cos_psi * F.x + sin_psi * F.z, z_2 = cos_psi * F.z - sin_psi * F.x;
    out.sine = {F.sine, sin_psi, sin_theta};
    out.cosine = {F.cosine, cos_psi, cos_theta};
    out.axis = {-leg.u, -leg.u, -x_2};
    out.x = F.x;
    out.z = F.z;
    setLinks<S>(F.x, F.z, x_2, sin_theta * leg.u + cos_theta * z_2, out);
    out.margins = {abs(sin_psi), S(1) / cos_theta};
  }

  template <class S>
  static void ends(const LegModel<S>& leg, LegState<S>& out) {
    out.O_1.setZero();
    out.O_2 = leg.l * out.e;
  }

  template <class S>
  static void requireRates(int index, const S& t, const LegState<S>& state) {
    requireRegular(state.margins.sine, "is stretched or folded, |sin psi|", index, t);
    requireRegular(state.cosine[2], "has its rod along the axis of its crank, cos theta", index, t);
  }

  /// Rows: (a) times s⃗; times l (c z + k_y cos ψ u) + c s⃗, which isolates ψ̇; times u.
  template <class S>
  static void rows(const LegModel<S>& leg, LegState<S>& out) {
    const S c = leg.s * out.cosine[2], k_y = leg.s * out.sine[2], &sin_psi = out.sine[1], &cos_psi = out.cosine[1];
    out.row[0].A = out.cosine[2] * leg.l * sin_psi;
    out.row[0].n = out.along;
    out.row[1].A = -c * c * leg.l * sin_psi;
    out.row[1].n = leg.l * (c * out.z + (k_y * cos_psi) * leg.u) + (c * leg.s) * out.along;
    out.row[2].A = c;
    out.row[2].n = leg.u;
  }

  template <class S>
  static void rowRates(const LegModel<S>& leg, LegState<S>& out) {
    const S c = leg.s * out.cosine[2], k_y = leg.s * out.sine[2], &sin_psi = out.sine[1], &cos_psi = out.cosine[1];
    const S &phi_dot = out.rate(0), &psi_dot = out.rate(1), &theta_dot = out.rate(2);
    const S c_dot = -k_y * theta_dot, k_y_dot = c * theta_dot, sin_dot = cos_psi * psi_dot;
    const Vector3<S> omega_2 = -(phi_dot + psi_dot) * leg.u - theta_dot * out.x_2;  // (b)
    const Vector3<S> along_dot = omega_2.cross(out.along), z_dot = -phi_dot * out.x;
    out.row[0].A_dot = leg.l * (c_dot * sin_psi + c * sin_dot) / leg.s;
    out.row[0].n_dot = along_dot;
    out.row[1].A_dot = -leg.l * c * (S(2) * c_dot * sin_psi + c * sin_dot);
    out.row[1].n_dot = leg.l * (c_dot * out.z + c * z_dot + (k_y_dot * cos_psi - k_y * sin_psi * psi_dot) * leg.u) +
                       leg.s * (c_dot * out.along + c * along_dot);
    out.row[2].A_dot = c_dot;
    out.row[2].n_dot.setZero();
  }

  template <bool with_rates = true, class S>
  static LinkMotions<S> links(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
                              const Vector3<S>& acceleration) {
    const Vector3<S> now_1 = -at.rate(0) * leg.u, now_2 = now_1 - at.rate(1) * leg.u - at.rate(2) * at.x_2;
    const Vector3<S> omega_1 = -rate(0) * leg.u, omega_2 = omega_1 - rate(1) * leg.u - rate(2) * at.x_2;  // (b)
    const Vector3<S> omega_1_dot = -acceleration(0) * leg.u;
    Vector3<S> omega_2_dot = omega_1_dot - acceleration(1) * leg.u - acceleration(2) * at.x_2;
    // −θ̇ (−(φ̇ + ψ̇) u) × x₂, where x₂ × u is z₂.
    omega_2_dot -= (rate(2) * (at.rate(0) + at.rate(1))) * at.x_2.cross(leg.u);
    LinkMotions<S> out{turning<with_rates>(omega_1, omega_1_dot, at.arm_1, Vector3<S>(now_1.cross(at.arm_1))),
                       turning<with_rates>(omega_2, omega_2_dot, at.arm_2, Vector3<S>(now_2.cross(at.arm_2)))};
    const LinkMotion<S> R_ = turning<with_rates>(omega_1, omega_1_dot, at.O_2, Vector3<S>(now_1.cross(at.O_2)));
    out.distal.c_dot += R_.c_dot;
    out.distal.c_ddot += R_.c_ddot;
    return out;
  }
};

constexpr Rus classOf(std::integral_constant<LegKind, LegKind::RUS>) { return {}; }

}  // namespace ursula::legs
