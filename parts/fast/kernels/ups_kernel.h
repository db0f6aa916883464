#pragma once

// The fast kernel of a UPS leg, cylinder and rod, in its plane (plane_leg.h). Internal. Rows of the map, q̇ⱼ = kⱼ · h:
//   φ: (−1/r, 0, 0)   ψ: (0, −S, C)/d   d: (0, C, S)

#include <array>
#include <type_traits>

#include "model/leg_kind.h"
#include "parts/fast/kernels/link_terms.h"
#include "parts/fast/kernels/off_line.h"

namespace ursula::kernel {

using Ups = std::integral_constant<LegKind, LegKind::UPS>;

/// The non-zero components of a row of the map: 1 for x, 2 for u, 4 for z.
constexpr std::array<int, 3> rowOfMap(Ups) { return {1, 6, 6}; }

/// `k` is AB along F̂; `guard` checks the requirements (leg_kernels.h).
template <class S, class Guard>
void place(Ups, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), r = sqrt(r2), d = sqrt(r2 + k.y() * k.y());
  guard.stroke(d, leg.s, leg.s + leg.l);
  guard.offAxis(r, leg.l + leg.s);
  const S per_both = S(1) / (r * d), per_r = d * per_both, per_d = r * per_both;  // division is expensive
  turnToB(k.x(), k.z(), per_r, out);
  out.C_1 = out.C_2 = k.y() * per_d;
  out.S_1 = out.S_2 = r * per_d;
  out.y = k.y();
  out.z = r;
  out.d = d;
  out.k = {Vector3<S>(-per_r, S(0), S(0)), Vector3<S>(S(0), -out.S_1 * per_d, out.C_1 * per_d),
           Vector3<S>(S(0), out.C_1, out.S_1)};
  out.lever = {r, d, S(1)};
}

/// h = [−φ̇ z, ḋ C − d ψ̇ S, ḋ S + d ψ̇ C], z = d S.
template <class S>
void setRates(Ups, const PlaneModel<S>&, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  const S &C = leg.C_1, &S_ = leg.S_1, &per_z = leg.k[0].x();
  const S &psi_y = leg.k[1].y(), &psi_z = leg.k[1].z();
  const S phi = h.x() * per_z, psi = h.y() * psi_y + h.z() * psi_z, d_dot = h.y() * C + h.z() * S_;
  const S a_z = a.z() + phi * phi * leg.z;
  const S phi_ddot = (a.x() + S(2) * phi * h.z()) * per_z;
  const S psi_ddot = a.y() * psi_y + a_z * psi_z - S(2) * d_dot * psi / leg.d;
  const S d_ddot = a.y() * C + a_z * S_ + leg.d * psi * psi;
  leg.rate = {phi, psi, d_dot};
  leg.acceleration = {phi_ddot, psi_ddot, d_ddot};
}

/// The rod slides along its link, so its tensor about A changes. A mass at r adds 2 ṙ χ̇ and −2 ṙ α̇ S to (c).
template <bool principal, class S>
Vector3<S> linkForces(Ups, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &C = leg.C_1, &S_ = leg.S_1, inner = leg.d - model.s + model.sigma;
  const LinkTurn<S> turn{C, S_, ratesOf(leg, 1), ratesOf(leg, 0)};
  const S &chi = turn.chi.dot, &alpha = turn.alpha.dot, first = model.mass_2 * inner, second = first * inner;
  Matrix3<S> J = model.I_2;
  J(0, 0) += second;
  J(1, 1) += second;
  const LinkMoment<S> cylinder = linkMoment<principal, S>(model.first_1, model.J_1, turn, base);
  const LinkMoment<S> rod = linkMoment<principal, S>(first, J, turn, base);
  const S slid = S(2) * first * leg.rate(2), alpha_S = alpha * S_;
  const S along = leg.acceleration(2) - inner * (chi * chi + alpha_S * alpha_S) + base.y() * C + base.z() * S_;
  return {slid * alpha_S * S_ - (cylinder.n_y + rod.n_y), cylinder.n_x + rod.n_x + slid * chi, model.mass_2 * along};
}

template <class S>
OffLinks<S> offLinks(Ups, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), e(S(0), leg.C_1, leg.S_1);
  const OffTurn<S> turn = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::UnitY());
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  OffEnd<S> rod{base + leg.acceleration(2) * e + (S(2) * leg.rate(2)) * turn.omega.cross(e), Matrix3<S>::Zero()};
  rod.V.col(2) = e;
  return {A.link(model.mass_1, model.off_1, x, e, model.rho, turn),
          rod.link(model.mass_2, model.off_2, x, e, leg.d - model.s + model.sigma, turn)};
}

/// In φ, ψ, d.
template <class S>
Matrix3<S> massMatrix(Ups, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto a = crossInertia<S>(model.J_1, leg.C_1, leg.S_1), b = crossInertia<S>(model.I_2, leg.C_1, leg.S_1);
  const S inner = leg.d - model.s + model.sigma, mu = model.mass_2 * inner * inner;
  return symmetric<S>(a.J + b.J + leg.S_1 * leg.S_1 * mu, -(a.P + b.P), S(0), a.x + b.x + mu, S(0), model.mass_2);
}

}  // namespace ursula::kernel
