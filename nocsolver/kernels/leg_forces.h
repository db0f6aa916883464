#pragma once

// The links' loads projected on a leg's coordinates, in the axes of the leg's plane. Internal. They need the rates of
// leg_rates.h; the recursion of chain_motion.h is their witness.

#include "nocsolver/kernels/dynamics.h"
#include "nocsolver/kernels/leg_rates.h"
#include "nocsolver/kernels/plane_link.h"

namespace ursula::kernel {

/// What drives against friction of the three coordinates.
template <class S>
Vector3<S> chainFriction(const ChainModel<S>& model, const ChainState<S>& leg) {
  return {frictionForce(model.viscous[0], model.coulomb[0], model.speed[0], leg.rate(0)),
          frictionForce(model.viscous[1], model.coulomb[1], model.speed[1], leg.rate(1)),
          frictionForce(model.viscous[2], model.coulomb[2], model.speed[2], leg.rate(2))};
}

template <class S>
Rates<S> ratesOf(const ChainState<S>& leg, int j) {
  return {leg.rate(j), leg.acceleration(j)};
}

template <class S>
Vector3<S> upsForces(const ChainModel<S>& model, const Vector3<S>& g, const ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[1], z_axis = x.cross(model.u);
  const S &C = leg.cosine[1], &S_ = leg.sine[1], inner = leg.cosine[2] - model.s + model.sigma;
  const Vector3<S> base = -alongAxes<S>(x, model.u, z_axis, g);
  const Rates<S> plane = ratesOf(leg, 0), turn = ratesOf(leg, 1), stroke = ratesOf(leg, 2);
  const LinkLoad<S> first = linkLoad<S>(model.mass_1, model.I_1, {model.rho, {S(0), S(0)}, C, S_, turn}, plane, base);
  const LinkLoad<S> second = linkLoad<S>(model.mass_2, model.I_2, {inner, stroke, C, S_, turn}, plane, base);
  return {-(first.n_y + second.n_y + (model.rho * first.f_x + inner * second.f_x) * S_),
          first.n_x + second.n_x + model.rho * first.f_t + inner * second.f_t, second.f_r};
}

template <class S>
Vector3<S> pusForces(const ChainModel<S>& model, const Vector3<S>& g, const ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[2], z_axis = x.cross(model.u);
  const S &C = leg.cosine[2], &S_ = leg.sine[2];
  Vector3<S> base = -alongAxes<S>(x, model.u, z_axis, g);
  base.y() += leg.acceleration(0);
  const LinkLoad<S> rod =
      linkLoad<S>(model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C, S_, ratesOf(leg, 2)}, ratesOf(leg, 1), base);
  return {model.mass_1 * base.y() + rod.f_r * C - rod.f_t * S_, -(rod.n_y + model.sigma * S_ * rod.f_x),
          rod.n_x + model.sigma * rod.f_t};
}

template <class S>
Vector3<S> rusForces(const ChainModel<S>& model, const Vector3<S>& g, const ChainState<S>& leg) {
  const Vector3<S> x = -leg.axis[2], z_axis = x.cross(model.u);
  const S &sin_psi = leg.sine[1], &cos_psi = leg.cosine[1], &C = leg.sine[2], &S_ = leg.cosine[2], &l = model.l;
  const auto [phi, phi_ddot] = ratesOf(leg, 0);
  const Rates<S> p{phi + leg.rate(1), phi_ddot + leg.acceleration(1)}, theta{-leg.rate(2), -leg.acceleration(2)};
  Vector3<S> base = -alongAxes<S>(x, model.u, z_axis, g);
  const S g_x = base.x() * cos_psi - base.z() * sin_psi;  // −g along x of the crank's plane
  base.x() -= l * (phi_ddot * cos_psi + phi * phi * sin_psi);
  base.z() += l * (phi_ddot * sin_psi - phi * phi * cos_psi);
  const LinkLoad<S> rod = linkLoad<S>(model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C, S_, theta}, p, base);
  const S on_psi = -(rod.n_y + model.sigma * S_ * rod.f_x);
  const S at_R = rod.f_x * cos_psi - (rod.f_r * S_ + rod.f_t * C) * sin_psi;  // the rod's force along the crank's x
  const S crank = model.I_1(1, 1) * phi_ddot + model.rho * model.mass_1 * (model.rho * phi_ddot - g_x);
  return {on_psi - l * at_R + crank, on_psi, -(rod.n_x + model.sigma * rod.f_t)};
}

template <class S>
Vector3<S> ursForces(const ChainModel<S>& model, const Vector3<S>& g, const ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[1], z_axis = x.cross(model.u);
  const S &C_1 = leg.cosine[1], &S_1 = leg.sine[1], &l = model.l;
  const S C_2 = leg.along_2.dot(model.u), S_2 = leg.along_2.dot(z_axis);
  Vector3<S> base = -alongAxes<S>(x, model.u, z_axis, g);
  const Rates<S> plane = ratesOf(leg, 0), turn = ratesOf(leg, 1);
  const auto& [phi, phi_ddot] = plane;
  const auto& [psi, psi_ddot] = turn;
  const Rates<S> chi{psi + leg.rate(2), psi_ddot + leg.acceleration(2)};
  const LinkLoad<S> first =
      linkLoad<S>(model.mass_1, model.I_1, {model.rho, {S(0), S(0)}, C_1, S_1, turn}, plane, base);
  const S knee = l * S_1;
  base += Vector3<S>(-phi_ddot * knee - S(2) * phi * l * C_1 * psi, -l * (S_1 * psi_ddot + C_1 * psi * psi),
                     l * (C_1 * psi_ddot - S_1 * psi * psi) - phi * phi * knee);
  const LinkLoad<S> second =
      linkLoad<S>(model.mass_2, model.I_2, {model.sigma, {S(0), S(0)}, C_2, S_2, chi}, plane, base);
  const S on_theta = second.n_x + model.sigma * second.f_t;
  const S f_y = second.f_r * C_2 - second.f_t * S_2, f_z = second.f_r * S_2 + second.f_t * C_2;
  return {-(first.n_y + second.n_y + model.rho * S_1 * first.f_x + (knee + model.sigma * S_2) * second.f_x),
          on_theta + first.n_x + model.rho * first.f_t + l * (C_1 * f_z - S_1 * f_y), on_theta};
}

}  // namespace ursula::kernel
