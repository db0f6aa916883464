#pragma once

// The links' loads projected on a leg's coordinates, in the axes of the leg's plane. Internal. They need the rates of
// leg_rates.h; `base` is −g along x, u, z of the plane. The recursion of chain_motion.h is the witness.

#include "nocsolver/kernels/plane_leg.h"
#include "nocsolver/kernels/plane_link.h"

namespace ursula::kernel {

template <class S>
Rates<S> ratesOf(const PlaneLeg<S>& leg, int j) {
  return {leg.rate(j), leg.acceleration(j)};
}

template <bool principal, class S>
Vector3<S> linkForces(Ups, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &C = leg.C_1, &S_ = leg.S_1, inner = leg.d - model.s + model.sigma;
  const Rates<S> plane = ratesOf(leg, 0), turn = ratesOf(leg, 1), stroke = ratesOf(leg, 2);
  const LinkLoad<S> first =
      linkLoad<principal, S>(model.mass_1, model.I_1, {model.rho, {S(0), S(0)}, C, S_, turn}, plane, base);
  const LinkLoad<S> second = linkLoad<principal, S>(model.mass_2, model.I_2, {inner, stroke, C, S_, turn}, plane, base);
  return {-(first.n_y + second.n_y + (model.rho * first.f_x + inner * second.f_x) * S_),
          first.n_x + second.n_x + model.rho * first.f_t + inner * second.f_t, second.f_r};
}

template <bool principal, class S>
Vector3<S> linkForces(Pus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &C = leg.C_2, &S_ = leg.S_2;
  const Vector3<S> carried(base.x(), base.y() + leg.acceleration(0), base.z());
  const LinkLoad<S> rod = linkLoad<principal, S>(
      model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C, S_, ratesOf(leg, 2)}, ratesOf(leg, 1), carried);
  return {model.mass_1 * carried.y() + rod.f_r * C - rod.f_t * S_, -(rod.n_y + model.sigma * S_ * rod.f_x),
          rod.n_x + model.sigma * rod.f_t};
}

template <bool principal, class S>
Vector3<S> linkForces(Rus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &sin_psi = leg.S_1, &cos_psi = leg.C_1, &C = leg.C_2, &S_ = leg.S_2, &l = model.l;
  const Rates<S> crank_rates = ratesOf(leg, 0);
  const S &phi = crank_rates.dot, &phi_ddot = crank_rates.ddot;
  const Rates<S> p{phi + leg.rate(1), phi_ddot + leg.acceleration(1)}, theta{-leg.rate(2), -leg.acceleration(2)};
  const S g_x = base.x() * cos_psi - base.z() * sin_psi;  // −g along x of the crank's plane
  const S turned = l * phi_ddot, outward = l * phi * phi;
  const Vector3<S> carried(base.x() - turned * cos_psi - outward * sin_psi, base.y(),
                           base.z() + turned * sin_psi - outward * cos_psi);
  const LinkLoad<S> rod =
      linkLoad<principal, S>(model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C, S_, theta}, p, carried);
  const S on_psi = -(rod.n_y + model.sigma * S_ * rod.f_x);
  const S at_R = rod.f_x * cos_psi - (rod.f_r * S_ + rod.f_t * C) * sin_psi;  // the rod's force along the crank's x
  const S crank = model.I_1(1, 1) * phi_ddot + model.rho * model.mass_1 * (model.rho * phi_ddot - g_x);
  return {on_psi - l * at_R + crank, on_psi, -(rod.n_x + model.sigma * rod.f_t)};
}

template <bool principal, class S>
Vector3<S> linkForces(Urs, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const S &C_1 = leg.C_1, &S_1 = leg.S_1, &C_2 = leg.C_2, &S_2 = leg.S_2, &l = model.l;
  const Rates<S> plane = ratesOf(leg, 0), turn = ratesOf(leg, 1);
  const S &phi = plane.dot, &phi_ddot = plane.ddot, &psi = turn.dot, &psi_ddot = turn.ddot;
  const Rates<S> chi{psi + leg.rate(2), psi_ddot + leg.acceleration(2)};
  const LinkLoad<S> first =
      linkLoad<principal, S>(model.mass_1, model.I_1, {model.rho, {S(0), S(0)}, C_1, S_1, turn}, plane, base);
  const S knee = l * S_1, psi_2 = psi * psi;
  const Vector3<S> carried(base.x() - phi_ddot * knee - S(2) * phi * l * C_1 * psi,
                           base.y() - l * (S_1 * psi_ddot + C_1 * psi_2),
                           base.z() + l * (C_1 * psi_ddot - S_1 * psi_2) - phi * phi * knee);
  const LinkLoad<S> second =
      linkLoad<principal, S>(model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C_2, S_2, chi}, plane, carried);
  const S on_theta = second.n_x + model.sigma * second.f_t;
  const S f_y = second.f_r * C_2 - second.f_t * S_2, f_z = second.f_r * S_2 + second.f_t * C_2;
  return {-(first.n_y + second.n_y + model.rho * S_1 * first.f_x + (knee + model.sigma * S_2) * second.f_x),
          on_theta + first.n_x + model.rho * first.f_t + l * (C_1 * f_z - S_1 * f_y), on_theta};
}

}  // namespace ursula::kernel
