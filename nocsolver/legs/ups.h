#pragma once

// The telescopic leg of the paper's Fig. 1, universal–prismatic–spherical. Internal.
//
//   AB = d e,  e = [0, cos ψ, sin ψ] in F = F̂R(φ):  d = ‖k‖,  φ = atan2(−k_x, k_z),  ψ = atan2(r, k_y)
//   v_B = −φ̇ r x + ψ̇ d (x × e) + ḋ e                                                       (a)
// Cylinder and rod turn together, with ω = −φ̇ u + ψ̇ x.                                    (b)
// The rod's inner end is d − s from A and stays within the cylinder: s < d < s + l.

#include "nocsolver/legs/by_rows.h"

namespace ursula::legs {

struct Ups : ByRows {
  /// Throws OutOfStroke and PointOnAxis.
  template <class S>
  static void displacement(const LegModel<S>& leg, int index, const S& t, LegState<S>& out) {
    using std::sqrt;
    const InAxes<S> B = inAxes(leg, out.AB);
    const S d = sqrt(B.r * B.r + B.k_y * B.k_y);
    requireStroke(d > leg.s, index, t, d, leg.s);
    requireStroke(d < leg.s + leg.l, index, t, d, S(leg.s + leg.l));
    requireOffAxis(B.r, S(leg.l + leg.s), index, t);
    const Plane<S> F = planeOf(leg, B);
    const S sin_psi = B.r / d, cos_psi = B.k_y / d;
    const Vector3<S> e = cos_psi * leg.u + sin_psi * F.z;
    out.sine = {F.sine, sin_psi, S(0)};
    out.cosine = {F.cosine, cos_psi, d};
    out.axis = {-leg.u, F.x, e};
    out.x = F.x;
    out.z = F.z;
    setLinks<S>(F.x, e, F.x, e, out);
    out.margins = {S(1), d / B.r};
  }

  template <class S>
  static void ends(const LegModel<S>& leg, LegState<S>& out) {
    out.O_1.setZero();
    out.O_2 = (out.cosine[2] - leg.s) * out.e;
  }

  template <class S>
  static void requireRates(int, const S&, const LegState<S>&) {}

  /// Rows of (a) along x, x × e, e.
  template <class S>
  static void rows(const LegModel<S>&, LegState<S>& out) {
    const S &d = out.cosine[2], &sin_psi = out.sine[1];
    out.row[0].A = -d * sin_psi;
    out.row[0].n = out.x;
    out.row[1].A = d;
    out.row[1].n = out.x.cross(out.e);
    out.row[2].A = S(1);
    out.row[2].n = out.e;
  }

  template <class S>
  static void rowRates(const LegModel<S>& leg, LegState<S>& out) {
    const S &d = out.cosine[2], &d_dot = out.rate(2);
    const Vector3<S> omega = -out.rate(0) * leg.u + out.rate(1) * out.x;  // (b)
    out.row[0].A_dot = -d_dot * out.sine[1] - d * out.cosine[1] * out.rate(1);
    out.row[0].n_dot = out.rate(0) * out.z;
    out.row[1].A_dot = d_dot;
    out.row[1].n_dot = omega.cross(out.row[1].n);
    out.row[2].A_dot = S(0);
    out.row[2].n_dot = omega.cross(out.e);
  }

  template <bool with_rates = true, class S>
  static LinkMotions<S> links(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
                              const Vector3<S>& acceleration) {
    const Vector3<S> now = -at.rate(0) * leg.u + at.rate(1) * at.x;
    const Vector3<S> omega = -rate(0) * leg.u + rate(1) * at.x;  // (b)
    Vector3<S> omega_dot = -acceleration(0) * leg.u + acceleration(1) * at.x;
    omega_dot += (rate(1) * at.rate(0)) * at.z;
    const Vector3<S> arm = at.O_2 + at.arm_2;  // from A to the rod's mass centre; it grows by ḋ e
    LinkMotions<S> out{turning<with_rates>(omega, omega_dot, at.arm_1, Vector3<S>(now.cross(at.arm_1))),
                       turning<with_rates>(omega, omega_dot, arm, Vector3<S>(now.cross(arm)))};
    out.distal.c_dot += rate(2) * at.e;
    out.distal.c_ddot += acceleration(2) * at.e;
    out.distal.c_ddot += rate(2) * now.cross(at.e);
    out.distal.c_ddot += at.rate(2) * omega.cross(at.e);
    return out;
  }
};

constexpr Ups classOf(std::integral_constant<LegKind, LegKind::UPS>) { return {}; }

}  // namespace ursula::legs
