#pragma once

// Rates and accelerations of a leg's joints for the motion of B, in closed form in the axes of the leg's plane.
// Internal. The recursion of chain_motion.h, which knows joints' axes alone, is its witness: tests hold the two
// together to rounding.
//
// Along x, y = u, z of the plane let v_B = h, a_B = a.

#include "nocsolver/chain_state.h"

namespace ursula::kernel {

template <class S>
Vector3<S> alongAxes(const Vector3<S>& x, const Vector3<S>& u, const Vector3<S>& z, const Vector3<S>& v) {
  return {x.dot(v), u.dot(v), z.dot(v)};
}

/// a_x = −α̈ z − 2 α̇ ż of a point in a plane that turns by α.
template <class S>
S planeAcceleration(const S& a_x, const S& alpha_dot, const S& per_z, const S& z_dot) {
  return -(a_x + S(2) * alpha_dot * z_dot) * per_z;
}

/// h = [−φ̇ z, ḋ C − d ψ̇ S, ḋ S + d ψ̇ C], z = d S.
template <class S>
void upsRates(const ChainModel<S>& model, const Vector3<S>& a_B, ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[1], z_axis = x.cross(model.u);
  const S &C = leg.cosine[1], &S_ = leg.sine[1], &d = leg.cosine[2];
  const Vector3<S> h = alongAxes<S>(x, model.u, z_axis, leg.v_B), a = alongAxes<S>(x, model.u, z_axis, a_B);
  const S z = d * S_, per_z = S(1) / z, per_d = S(1) / d;
  const S phi = -h.x() * per_z, psi = (h.z() * C - h.y() * S_) * per_d, d_dot = h.y() * C + h.z() * S_;
  const S a_z = a.z() + phi * phi * z;
  const S phi_ddot = planeAcceleration<S>(a.x(), phi, per_z, h.z());
  const S psi_ddot = (a_z * C - a.y() * S_ - S(2) * d_dot * psi) * per_d;
  const S d_ddot = a.y() * C + a_z * S_ + d * psi * psi;
  leg.rate << phi, psi, d_dot;
  leg.acceleration << phi_ddot, psi_ddot, d_ddot;
}

/// h = [−ψ̇ z, ḋ − s θ̇ S, s θ̇ C], z = s S.
template <class S>
void pusRates(const ChainModel<S>& model, const Vector3<S>& a_B, ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[2], z_axis = x.cross(model.u);
  const S &C = leg.cosine[2], &S_ = leg.sine[2], &s = model.s;
  const Vector3<S> h = alongAxes<S>(x, model.u, z_axis, leg.v_B), a = alongAxes<S>(x, model.u, z_axis, a_B);
  const S z = s * S_, per_z = S(1) / z, per_y = S(1) / (s * C);
  const S psi = -h.x() * per_z, theta = h.z() * per_y, d_dot = h.y() + z * theta;
  const S psi_ddot = planeAcceleration<S>(a.x(), psi, per_z, h.z());
  const S theta_ddot = (a.z() + psi * psi * z + z * theta * theta) * per_y;
  const S d_ddot = a.y() + z * theta_ddot + s * C * theta * theta;
  leg.rate << d_dot, psi, theta;
  leg.acceleration << d_ddot, psi_ddot, theta_ddot;
}

/// In the rod's plane F₂ = F̂R(φ + ψ), with c = s cos θ, p = φ̇ + ψ̇, R from A by l z, z and x of F = F̂R(φ):
///   h = [−l φ̇ cos ψ − p c, c θ̇, l φ̇ sin ψ − k_y θ̇]
///   a = [−l (φ̈ cos ψ + φ̇² sin ψ) − ṗ c − 2 p ċ, c θ̈ − k_y θ̇², l (φ̈ sin ψ − φ̇² cos ψ) + c̈ − p² c]
template <class S>
void rusRates(const ChainModel<S>& model, const Vector3<S>& a_B, ChainState<S>& leg) {
  const Vector3<S> x = -leg.axis[2], z_axis = x.cross(model.u);
  const S &sin_psi = leg.sine[1], &cos_psi = leg.cosine[1], &C = leg.sine[2], &S_ = leg.cosine[2], &l = model.l;
  const S c = model.s * S_, k_y = model.s * C;
  const Vector3<S> h = alongAxes<S>(x, model.u, z_axis, leg.v_B), a = alongAxes<S>(x, model.u, z_axis, a_B);
  const S per_c = S(1) / c, per_lever = S(1) / (l * sin_psi);
  const S theta = h.y() * per_c, phi = (h.z() + k_y * theta) * per_lever, p = -(h.x() + l * phi * cos_psi) * per_c;
  const S c_dot = -k_y * theta, theta_ddot = (a.y() + k_y * theta * theta) * per_c;
  const S c_ddot = -(k_y * theta_ddot + c * theta * theta);
  const S phi_ddot = (a.z() + l * phi * phi * cos_psi - c_ddot + p * p * c) * per_lever;
  const S R_x = -l * (phi_ddot * cos_psi + phi * phi * sin_psi);
  const S p_dot = (R_x - a.x() - S(2) * p * c_dot) * per_c;
  leg.rate << phi, p - phi, theta;
  leg.acceleration << phi_ddot, p_dot - phi_ddot, theta_ddot;
}

/// With e = [0, C₁, S₁], s = [0, C₂, S₂], χ̇ = ψ̇ + θ̇:  h = [−φ̇ z, −l ψ̇ S₁ − s χ̇ S₂, l ψ̇ C₁ + s χ̇ C₂],
/// z = l S₁ + s S₂.
template <class S>
void ursRates(const ChainModel<S>& model, const Vector3<S>& a_B, ChainState<S>& leg) {
  const Vector3<S>&x = leg.axis[1], z_axis = x.cross(model.u);
  const S &C_1 = leg.cosine[1], &S_1 = leg.sine[1], &l = model.l, &s = model.s;
  const S C_2 = leg.along_2.dot(model.u), S_2 = leg.along_2.dot(z_axis);
  const Vector3<S> h = alongAxes<S>(x, model.u, z_axis, leg.v_B), a = alongAxes<S>(x, model.u, z_axis, a_B);
  const S per_ls = S(-1) / (l * s * leg.sine[2]);
  const auto solve = [&](const S& y, const S& z, S& psi, S& chi) {
    psi = s * (C_2 * y + S_2 * z) * per_ls;
    chi = -l * (C_1 * y + S_1 * z) * per_ls;
  };
  const S z = l * S_1 + s * S_2, per_z = S(1) / z;
  const S phi = -h.x() * per_z, phi_ddot = planeAcceleration<S>(a.x(), phi, per_z, h.z());
  S psi, chi, psi_ddot, chi_ddot;
  solve(h.y(), h.z(), psi, chi);
  solve(a.y() + l * C_1 * psi * psi + s * C_2 * chi * chi,
        a.z() + phi * phi * z + l * S_1 * psi * psi + s * S_2 * chi * chi, psi_ddot, chi_ddot);
  leg.rate << phi, psi, chi - psi;
  leg.acceleration << phi_ddot, psi_ddot, chi_ddot - psi_ddot;
}

}  // namespace ursula::kernel
