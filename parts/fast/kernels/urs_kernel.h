#pragma once

// The fast kernel of a URS leg, proximal and distal link, in its plane (plane_leg.h). Internal. Rows of the map, q̇ⱼ =
// kⱼ · h:
//   φ: (−1/r, 0, 0)   ψ: −(0, C₂, S₂)/(l sin θ)   θ: (0, k_y, r)/(l s sin θ),  second link along (0, C₂, S₂)

#include <array>
#include <type_traits>

#include "model/leg_kind.h"
#include "parts/fast/kernels/link_terms.h"
#include "parts/fast/kernels/off_line.h"

namespace ursula::kernel {

using Urs = std::integral_constant<LegKind, LegKind::URS>;

/// The non-zero components of a row of the map: 1 for x, 2 for u, 4 for z.
constexpr std::array<int, 3> rowOfMap(Urs) { return {1, 6, 6}; }

/// `k` is AB along F̂; `guard` checks the requirements (leg_kernels.h).
template <class S, class Guard>
void place(Urs, const PlaneModel<S>& leg, const Vector3<S>& k, Guard& guard, PlaneLeg<S>& out) {
  using std::abs;
  using std::sqrt;
  const S r2 = k.x() * k.x() + k.z() * k.z(), r = sqrt(r2), q2 = r2 + k.y() * k.y();
  // Computes 1 ∓ cos θ without the cancellation of (4a) near a stretched or folded leg.
  const S difference = leg.l - leg.s, sum = leg.l + leg.s, per_ls = leg.per_l * leg.per_s, half = S(0.5) * per_ls;
  const S one_minus = (q2 - difference * difference) * half, one_plus = (sum * sum - q2) * half;
  guard.reach(one_minus, q2, difference);
  guard.reach(one_plus, q2, sum);
  guard.offAxis(r, sum);
  const S cos_theta = S(0.5) * (one_plus - one_minus), sin_theta = leg.knee * sqrt(one_minus * one_plus);
  guard.regular(sin_theta, "is stretched or folded, |sin theta|");
  const S r_sine = r * sin_theta, per_all = S(1) / (r_sine * q2);
  const S per_q2 = r_sine * per_all, per_r = sin_theta * q2 * per_all, per_sine = r * q2 * per_all;
  turnToB(k.x(), k.z(), per_r, out);
  // Turns AB to the first link by the angle with sine s sin θ and cosine l − s cos θ, both over q.
  const S across = leg.s * sin_theta * per_q2, along = (leg.l - leg.s * cos_theta) * per_q2;
  out.C_1 = along * k.y() - across * r;
  out.S_1 = across * k.y() + along * r;
  out.C_2 = -(out.C_1 * cos_theta - out.S_1 * sin_theta);
  out.S_2 = -(out.S_1 * cos_theta + out.C_1 * sin_theta);
  out.y = k.y();
  out.z = r;
  out.d = S(0);
  const S psi = -leg.s * per_ls * per_sine, theta = per_ls * per_sine;
  out.k = {Vector3<S>(-per_r, S(0), S(0)), Vector3<S>(S(0), psi * out.C_2, psi * out.S_2),
           Vector3<S>(S(0), theta * k.y(), theta * r)};
  const S size = abs(leg.l * sin_theta);
  out.lever = {r, size, size * leg.s * (r + abs(k.y())) * per_q2};
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

template <class S>
OffLinks<S> offLinks(Urs, const PlaneModel<S>& model, const Vector3<S>& base, const PlaneLeg<S>& leg) {
  const Vector3<S> x = Vector3<S>::UnitX(), e(S(0), leg.C_1, leg.S_1), s(S(0), leg.C_2, leg.S_2);
  const OffTurn<S> first = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>::UnitY());
  const OffTurn<S> second = offTurn<S>(leg, Vector3<S>::UnitX(), Vector3<S>(S(0), S(1), S(1)));
  const OffEnd<S> A{base, Matrix3<S>::Zero()};
  return {A.link(model.mass_1, model.off_1, x, e, model.rho, first),
          A.along(first, model.l * e).link(model.mass_2, model.off_2, x, s, model.sigma, second)};
}

/// In φ, ψ, θ.
template <class S>
Matrix3<S> massMatrix(Urs, const PlaneModel<S>& model, const PlaneLeg<S>& leg) {
  const auto a = crossInertia<S>(model.J_1, leg.C_1, leg.S_1), b = crossInertia<S>(model.J_2, leg.C_2, leg.S_2);
  const S across = leg.S_1 * leg.S_2, k = model.first_2 * model.l * (across + leg.C_1 * leg.C_2);
  const S knee = model.l * (model.mass_2 * model.l * (leg.S_1 * leg.S_1) + S(2) * model.first_2 * across);
  return symmetric<S>(a.J + b.J + knee, -(a.P + b.P), -b.P, b.x + S(2) * k + model.mass_2 * model.l * model.l + a.x,
                      b.x + k, b.x);
}

}  // namespace ursula::kernel
