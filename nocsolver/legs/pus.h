#pragma once

// Carriage and rod (Hexaglide), prismatic–universal–spherical. Internal.
//
//   AB = d u + s⃗,  s⃗ = s (cos θ u + sin θ z),  z of F = F̂R(ψ):  ψ = atan2(−k_x, k_z),  s sin θ = r,  d = k_y − s cos θ
//   v_B = ḋ u − ψ̇ r x + θ̇ s (cos θ z − sin θ u)                                            (a)
// The carriage does not turn; the rod turns with ω = −ψ̇ u + θ̇ x.                           (b)

#include "nocsolver/legs/by_rows.h"

namespace ursula::legs {

struct Pus : ByRows {
  /// Throws OutOfReach and PointOnAxis.
  template <class S>
  static void displacement(const LegModel<S>& leg, int index, const S& t, LegState<S>& out) {
    using std::abs;
    using std::sqrt;
    const InAxes<S> B = inAxes(leg, out.AB);
    const S square = (leg.s - B.r) * (leg.s + B.r);
    requireReach(square >= S(0), index, t, B.r, leg.s);
    requireOffAxis(B.r, leg.s, index, t);
    const S along = leg.knee * sqrt(square);  // s cos θ
    const S d = B.k_y - along, sin_theta = B.r / leg.s, cos_theta = along / leg.s;
    const Plane<S> F = planeOf(leg, B);
    out.sine = {S(0), F.sine, sin_theta};
    out.cosine = {d, F.cosine, cos_theta};
    out.axis = {leg.u, -leg.u, F.x};
    out.x = F.x;
    out.z = F.z;
    setLinks<S>(F.x, leg.u, F.x, cos_theta * leg.u + sin_theta * F.z, out);
    out.margins = {abs(cos_theta), S(1) / sin_theta};
  }

  template <class S>
  static void ends(const LegModel<S>& leg, LegState<S>& out) {
    out.R_1 << leg.x_hat, leg.u, leg.z_hat;  // the carriage does not turn
    out.O_1 = out.O_2 = out.cosine[0] * leg.u;
  }

  template <class S>
  static void requireRates(int index, const S& t, const LegState<S>& state) {
    requireRegular(state.margins.sine, "has its rod across its rail, |cos theta|", index, t);
  }

  /// Rows of (a) along s⃗, x, z.
  template <class S>
  static void rows(const LegModel<S>& leg, LegState<S>& out) {
    const S &sin_theta = out.sine[2], &cos_theta = out.cosine[2];
    out.row[0].A = cos_theta;
    out.row[0].n = out.along;
    out.row[1].A = -leg.s * sin_theta;
    out.row[1].n = out.x;
    out.row[2].A = leg.s * cos_theta;
    out.row[2].n = out.z;
  }

  template <class S>
  static void rowRates(const LegModel<S>& leg, LegState<S>& out) {
    const S &sin_theta = out.sine[2], &cos_theta = out.cosine[2], &theta_dot = out.rate(2);
    const Vector3<S> omega = -out.rate(1) * leg.u + theta_dot * out.x;  // (b)
    out.row[0].A_dot = -sin_theta * theta_dot;
    out.row[0].n_dot = omega.cross(out.along);
    out.row[1].A_dot = -leg.s * cos_theta * theta_dot;
    out.row[1].n_dot = out.rate(1) * out.z;
    out.row[2].A_dot = -leg.s * sin_theta * theta_dot;
    out.row[2].n_dot = -out.rate(1) * out.x;
  }

  template <bool with_rates = true, class S>
  static LinkMotions<S> links(const LegModel<S>& leg, const LegState<S>& at, const Vector3<S>& rate,
                              const Vector3<S>& acceleration) {
    const Vector3<S> zero = Vector3<S>::Zero(), v = rate(0) * leg.u, a = acceleration(0) * leg.u;
    const Vector3<S> now = -at.rate(1) * leg.u + at.rate(2) * at.x;
    const Vector3<S> omega = -rate(1) * leg.u + rate(2) * at.x;  // (b)
    Vector3<S> omega_dot = -acceleration(1) * leg.u + acceleration(2) * at.x;
    omega_dot += (rate(2) * at.rate(1)) * at.z;
    LinkMotions<S> out{{zero, v, zero, a},
                       turning<with_rates>(omega, omega_dot, at.arm_2, Vector3<S>(now.cross(at.arm_2)))};
    out.distal.c_dot += v;
    out.distal.c_ddot += a;
    return out;
  }
};

constexpr Pus classOf(std::integral_constant<LegKind, LegKind::PUS>) { return {}; }

}  // namespace ursula::legs
