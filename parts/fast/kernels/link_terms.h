#pragma once

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
// With I about any point of the link's axis, the products about x and the plane's axis are
//   P = I_xy S + I_xz C,  J = I_yy S² + 2 I_yz S C + I_zz C²                                                     (e)

#include "base/scalar.h"
#include "parts/fast/kernels/plane_leg.h"

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

template <class S>
struct CrossInertia {
  S x, P, J;
};

/// (e)
template <class S>
CrossInertia<S> crossInertia(const Matrix3<S>& I, const S& C, const S& S_) {
  return {I(0, 0), I(0, 1) * S_ + I(0, 2) * C, I(1, 1) * S_ * S_ + S(2) * I(1, 2) * S_ * C + I(2, 2) * C * C};
}

template <class S>
Matrix3<S> symmetric(const S& a, const S& ab, const S& ac, const S& b, const S& bc, const S& c) {
  Matrix3<S> M;
  M << a, ab, ac, ab, b, bc, ac, bc, c;
  return M;
}

}  // namespace ursula::kernel
