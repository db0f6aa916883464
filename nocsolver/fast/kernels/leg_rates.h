#pragma once

// Rates and accelerations of a leg's coordinates from B's motion, in closed form in the axes of the leg's plane.
// Internal. legs/, which works with angles, is the independent reference; tests compare both to rounding.
//
// Along x, u, z of the plane v_B = h and a_B = a; the rows of the legs' maps in plane_leg.h give the rates.

#include "nocsolver/fast/kernels/plane_leg.h"

namespace ursula::kernel {

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

/// h = [−ψ̇ z, ḋ − z θ̇, y θ̇], y = s cos θ, z = s sin θ.
template <class S>
void setRates(Pus, const PlaneModel<S>&, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  const S &per_z = leg.k[1].x(), &per_y = leg.k[2].z(), &z = leg.z, &y = leg.y;
  const S psi = h.x() * per_z, theta = h.z() * per_y, d_dot = h.y() + z * theta;
  const S theta_2 = theta * theta;
  const S psi_ddot = (a.x() + S(2) * psi * h.z()) * per_z;
  const S theta_ddot = (a.z() + (psi * psi + theta_2) * z) * per_y;
  const S d_ddot = a.y() + z * theta_ddot + y * theta_2;
  leg.rate = {d_dot, psi, theta};
  leg.acceleration = {d_ddot, psi_ddot, theta_ddot};
}

/// In the rod's plane F₂ = F̂R(φ + ψ), with c = s cos θ, p = φ̇ + ψ̇, R from A by l z, z and x of F = F̂R(φ):
///   h = [−l φ̇ cos ψ − p c, c θ̇, l φ̇ sin ψ − k_y θ̇]
///   a = [−l (φ̈ cos ψ + φ̇² sin ψ) − ṗ c − 2 p ċ, c θ̈ − k_y θ̇², l (φ̈ sin ψ − φ̇² cos ψ) + c̈ − p² c]
template <class S>
void setRates(Rus, const PlaneModel<S>& model, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  const S &cos_psi = leg.C_1, &sin_psi = leg.S_1, &l = model.l, &c = leg.z, &k_y = leg.y;
  const S &per_c = leg.k[2].y(), &per_lever = leg.k[0].z();
  const S theta = h.y() * per_c, phi = (h.z() + k_y * theta) * per_lever, p = -(h.x() + l * phi * cos_psi) * per_c;
  const S c_dot = -k_y * theta, theta_ddot = (a.y() + k_y * theta * theta) * per_c, phi_2 = l * phi * phi;
  const S c_ddot = -(k_y * theta_ddot + c * theta * theta);
  const S phi_ddot = (a.z() + phi_2 * cos_psi - c_ddot + p * p * c) * per_lever;
  const S R_x = -(l * phi_ddot * cos_psi + phi_2 * sin_psi);
  const S p_dot = (R_x - a.x() - S(2) * p * c_dot) * per_c;
  leg.rate = {phi, p - phi, theta};
  leg.acceleration = {phi_ddot, p_dot - phi_ddot, theta_ddot};
}

/// With e = [0, C₁, S₁], s = [0, C₂, S₂], χ̇ = ψ̇ + θ̇:  h = [−φ̇ z, −l ψ̇ S₁ − s χ̇ S₂, l ψ̇ C₁ + s χ̇ C₂],
/// z = l S₁ + s S₂.
template <class S>
void setRates(Urs, const PlaneModel<S>& model, const Vector3<S>& h, const Vector3<S>& a, PlaneLeg<S>& leg) {
  const S &C_1 = leg.C_1, &S_1 = leg.S_1, &C_2 = leg.C_2, &S_2 = leg.S_2, &per_z = leg.k[0].x();
  const auto solve = [&leg](const S& y, const S& z, S& psi, S& theta) {
    psi = leg.k[1].y() * y + leg.k[1].z() * z;
    theta = leg.k[2].y() * y + leg.k[2].z() * z;
  };
  const S phi = h.x() * per_z, phi_ddot = (a.x() + S(2) * phi * h.z()) * per_z;
  S psi, theta, psi_ddot, theta_ddot;
  solve(h.y(), h.z(), psi, theta);
  const S chi = psi + theta, first = model.l * psi * psi, second = model.s * chi * chi;
  solve(a.y() + C_1 * first + C_2 * second, a.z() + phi * phi * leg.z + S_1 * first + S_2 * second, psi_ddot,
        theta_ddot);
  leg.rate = {phi, psi, theta};
  leg.acceleration = {phi_ddot, psi_ddot, theta_ddot};
}

}  // namespace ursula::kernel
