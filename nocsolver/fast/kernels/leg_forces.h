#pragma once

// The links' loads projected on a leg's coordinates, in the axes of the leg's plane. Internal. They need the rates of
// leg_rates.h; `base` is −g along x, u, z of the plane. The recursion of chain_motion.h is the independent reference.

#include "nocsolver/fast/kernels/plane_leg.h"
#include "nocsolver/fast/kernels/plane_link.h"

namespace ursula::kernel {

template <class S>
Rates<S> ratesOf(const PlaneLeg<S>& leg, int j) {
  return {leg.rate(j), leg.acceleration(j)};
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

template <bool principal, class S>
Vector3<S> linkForces(Pus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> carried(base.x(), base.y() + leg.acceleration(0), base.z());
  const LinkTurn<S> turn{leg.C_2, leg.S_2, ratesOf(leg, 2), ratesOf(leg, 1)};
  const LinkMoment<S> rod = linkMoment<principal, S>(model.first_2, model.J_2, turn, carried);
  const S along = (model.mass_1 + model.mass_2) * carried.y() + turning<S>(model.first_2, turn).y();
  return {along, -rod.n_y, rod.n_x};
}

template <bool principal, class S>
Vector3<S> linkForces(Rus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &sin_psi = leg.S_1, &cos_psi = leg.C_1, &l = model.l;
  const S &phi = leg.rate(0), &phi_ddot = leg.acceleration(0);
  const LinkTurn<S> turn{
      leg.C_2, leg.S_2, {-leg.rate(2), -leg.acceleration(2)}, {phi + leg.rate(1), phi_ddot + leg.acceleration(1)}};
  const S g_x = base.x() * cos_psi - base.z() * sin_psi;  // −g along x of the crank's plane
  const S turned = l * phi_ddot, outward = l * phi * phi;
  const Vector3<S> carried(base.x() - turned * cos_psi - outward * sin_psi, base.y(),
                           base.z() + turned * sin_psi - outward * cos_psi);
  const LinkMoment<S> rod = linkMoment<principal, S>(model.first_2, model.J_2, turn, carried);
  const Vector3<S> f = model.mass_2 * carried + turning<S>(model.first_2, turn);
  const S at_R = f.x() * cos_psi - f.z() * sin_psi;  // the rod's force along the crank's x
  return {model.J_1(1, 1) * phi_ddot - model.first_1 * g_x - rod.n_y - l * at_R, -rod.n_y, -rod.n_x};
}

template <bool principal, class S>
Vector3<S> linkForces(Urs, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &C_1 = leg.C_1, &S_1 = leg.S_1, &l = model.l;
  const Rates<S> plane = ratesOf(leg, 0), psi = ratesOf(leg, 1);
  const LinkTurn<S> first{C_1, S_1, psi, plane};
  const LinkTurn<S> second{leg.C_2, leg.S_2, {psi.dot + leg.rate(2), psi.ddot + leg.acceleration(2)}, plane};
  const Vector3<S> carried = base + turning<S>(l, first);
  const LinkMoment<S> proximal = linkMoment<principal, S>(model.first_1, model.J_1, first, base);
  const LinkMoment<S> distal = linkMoment<principal, S>(model.first_2, model.J_2, second, carried);
  const Vector3<S> f = model.mass_2 * carried + turning<S>(model.first_2, second);
  return {-(proximal.n_y + distal.n_y + l * S_1 * f.x()), distal.n_x + proximal.n_x + l * (C_1 * f.z() - S_1 * f.y()),
          distal.n_x};
}

}  // namespace ursula::kernel
