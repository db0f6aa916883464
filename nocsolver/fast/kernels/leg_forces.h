#pragma once

#include "base/scalar.h"
#include "nocsolver/fast/kernels/plane_leg.h"

// A link whose axis lies in a plane that turns about −u: both links of URS and UPS, the rod of PUS and RUS. Internal.
//
// Axes are x, y = u, z of the plane F, with r = [0, C, S] along the link. The plane turns by α, the link by χ about x
// and its first end O. J is its tensor about O, m its mass, ρ the distance of its mass centre, b = ä_O − g:
//   ω = [χ̇, −α̇ S, −α̇ C],  ω̇ = [χ̈, −α̈ S − α̇ χ̇ C, −α̈ C + α̇ χ̇ S] in the link's frame [x, r × x, r]             (a)
//   n_O = J ω̇ + ω × J ω + m ρ r × b                                                                            (b)
//   f = m b + m ρ [−α̈ S − 2 α̇ χ̇ C,  −χ̈ S − χ̇² C,  χ̈ C − (χ̇² + α̇²) S]                                          (c)
// For principal axes, with D = (J_z − J_y) S C, K = J_y S² + J_z C²:
//   n_x = J_x χ̈ + D α̇² + …,  n_y = −K α̈ + 2 D α̇ χ̇ + …                                                        (d)
//
// Below, the links' loads are projected on a leg's coordinates, in the axes of the leg's plane. They need the rates of
// leg_rates.h; `base` is −g along x, u, z of the plane. noc/ is the independent reference.

namespace ursula::kernel {

/// The derivatives of an angle or a distance.
template <class S>
struct Rates {
  S dot, ddot;
};

/// Position and rotation of a link: cosine and sine of χ, rates of χ and of the plane's α.
template <class S>
struct LinkTurn {
  S C, S_;
  Rates<S> chi, alpha;
};

/// The moments that move a link about its first end against gravity, about x and y of the plane.
template <class S>
struct LinkMoment {
  S n_x, n_y;
};

/// `first` is m ρ; J is diagonal if `principal`. `base` is ä_O − g along x, y, z of the plane.
template <bool principal, class S>
LinkMoment<S> linkMoment(const S& first, const Matrix3<S>& J, const LinkTurn<S>& link, const Vector3<S>& base) {
  const S &C = link.C, &S_ = link.S_, &chi = link.chi.dot, &alpha = link.alpha.dot;
  const S n_x = first * (base.z() * C - base.y() * S_), n_y = first * S_ * base.x();  // (b)
  if constexpr (principal) {
    const S D = (J(2, 2) - J(1, 1)) * (S_ * C), K = J(1, 1) * (S_ * S_) + J(2, 2) * (C * C), Da = D * alpha;
    return {n_x + J(0, 0) * link.chi.ddot + Da * alpha, n_y - K * link.alpha.ddot + S(2) * (Da * chi)};  // (d)
  } else {
    const Vector3<S> omega(chi, -alpha * S_, -alpha * C);
    const Vector3<S> omega_dot(link.chi.ddot, -link.alpha.ddot * S_ - alpha * chi * C,
                               -link.alpha.ddot * C + alpha * chi * S_);  // (a)
    const Vector3<S> n = J * omega_dot + omega.cross(Vector3<S>(J * omega));
    return {n_x + n.x(), n_y + S_ * n.y() + C * n.z()};
  }
}

/// (c) without m b, along x, y, z of the plane. For m ρ = l this is the acceleration of a point at l relative to O.
template <class S>
Vector3<S> turning(const S& first, const LinkTurn<S>& link) {
  const S &C = link.C, &S_ = link.S_, &chi = link.chi.dot, &alpha = link.alpha.dot;
  const S chi_2 = chi * chi;
  return {-first * (link.alpha.ddot * S_ + S(2) * (alpha * chi) * C), -first * (link.chi.ddot * S_ + chi_2 * C),
          first * (link.chi.ddot * C - (chi_2 + alpha * alpha) * S_)};
}

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
