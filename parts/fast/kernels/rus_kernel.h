#pragma once

// The fast kernel of a RUS leg, crank and rod, in its plane (plane_leg.h). Internal. Rows of the map, q̇ⱼ = kⱼ · h:
//   φ: (0, k_y/c, 1)/(l sin ψ)   ψ: −(1, k_y cos ψ/(c sin ψ), cos ψ/sin ψ)/c − that of φ   θ: (0, 1/c, 0),
//   c = s cos θ

#include <array>
#include <type_traits>

#include "model/leg_kind.h"
#include "parts/fast/kernels/link_terms.h"
#include "parts/fast/kernels/off_line.h"

namespace ursula::kernel {

using Rus = std::integral_constant<LegKind, LegKind::RUS>;

/// The non-zero components of a row of the map: 1 for x, 2 for u, 4 for z.
constexpr std::array<int, 3> rowOfMap(Rus) { return {6, 7, 2}; }

/// `k` is AB along F̂; `guard` checks the requirements (leg_kernels.h).
template <class S, class Guard>
void place(Rus, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::abs;
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), c2 = (leg.s - k.y()) * (leg.s + k.y()), c = sqrt(c2);
  guard.reach(c2, k.y() * k.y(), leg.s);
  const S per_c = S(1) / c, half = S(0.5) * leg.per_l * per_c;
  const S difference = leg.l - c, sum = leg.l + c;
  const S one_plus = (r2 - difference * difference) * half, one_minus = (sum * sum - r2) * half;
  guard.reach(one_minus, r2, sum);
  guard.reach(one_plus, r2, difference);
  const S r = sqrt(r2);
  guard.offAxis(r, leg.l + leg.s);
  const S cos_psi = S(0.5) * (one_plus - one_minus), sin_psi = leg.knee * sqrt(one_minus * one_plus);
  guard.regular(sin_psi, "is stretched or folded, |sin psi|");
  guard.regular(c * leg.per_s, "has its rod along the axis of its crank, cos theta");
  // Turns B's plane to the rod's by the angle with sine l sin ψ and cosine c + l cos ψ, both over r.
  const S per_both = S(1) / (r2 * sin_psi), per_r2 = sin_psi * per_both, per_sine = r2 * per_both;
  const S on_sine = leg.l * sin_psi * per_r2, on_cosine = (c + leg.l * cos_psi) * per_r2;
  out.sine = on_sine * k.z() - on_cosine * k.x();
  out.cosine = on_cosine * k.z() + on_sine * k.x();
  out.C_1 = cos_psi;
  out.S_1 = sin_psi;
  out.C_2 = k.y() * leg.per_s;
  out.S_2 = c * leg.per_s;
  out.y = k.y();
  out.z = c;
  out.d = S(0);
  const S phi = per_sine * leg.per_l, slope = k.y() * per_c;
  const S psi = -per_c * cos_psi * per_sine - phi;
  out.k = {Vector3<S>(S(0), slope * phi, phi), Vector3<S>(-per_c, slope * psi, psi), Vector3<S>(S(0), per_c, S(0))};
  const S size = abs(leg.l * sin_psi) * c * leg.per_s;
  out.lever = {size, c * size * leg.per_sum, c};
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

template <class S>
OffLinks<S> offLinks(Rus, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), s(S(0), leg.C_2, leg.S_2);
  const Vector3<S> x_crank(leg.C_1, S(0), -leg.S_1), e(leg.S_1, S(0), leg.C_1);
  const OffTurn<S> crank = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::Zero());
  const OffTurn<S> rod = offTurn<S>(leg, Vector3<S>(S(1), S(1), S(0)), Vector3<S>(S(0), S(0), S(-1)));
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  return {A.link(model.mass_1, model.off_1, x_crank, e, model.rho, crank),
          A.along(crank, model.l * e).link(model.mass_2, model.off_2, x, s, model.sigma, rod)};
}

/// In φ, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Rus, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto rod = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  const S e = model.first_2 * model.l * leg.S_2 * leg.C_1, g = model.first_2 * model.l * leg.C_2 * leg.S_1;
  const S crank = model.mass_2 * model.l * model.l + model.J_1(1, 1);
  return symmetric<S>(rod.J + S(2) * e + crank, rod.J + e, rod.P - g, rod.J, rod.P, rod.x);
}

}  // namespace ursula::kernel
