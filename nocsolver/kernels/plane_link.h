#pragma once

// A link whose axis lies in a plane that turns about −u: of URS and UPS both links, of PUS the rod, of RUS crank and
// rod, each in its own plane. Internal.
//
// Axes x, y = u, z of the plane F; along and across the link r = [0, C, S], t = [0, −S, C]; the plane turns by α, the
// link by χ about x. A point at the distance r from the link's origin O, in (x, r, t):
//   c̈ = ä_O + [−α̈ z − 2 α̇ ż,  r̈ − r χ̇² − α̇² z S,  r χ̈ + 2 ṙ χ̇ − α̇² z C],  z = r S,  ż = ṙ S + r χ̇ C     (a)
//   ω = [χ̇, −α̇, 0],  ω̇ = [χ̈, −α̈, α̇ χ̇] in F;  in the link's frame [x, r × x, r]:
//   ω = [χ̇, −α̇ S, −α̇ C],  ω̇ = [χ̈, −α̈ S − α̇ χ̇ C, −α̈ C + α̇ χ̇ S]                                   (b)

#include "model/scalar.h"

namespace ursula::kernel {

/// An angle or a distance with its derivatives.
template <class S>
struct Rates {
  S dot, ddot;
};

/// Where the link's mass centre is: distance r from O with its derivatives, and the cosine and sine of χ.
template <class S>
struct OnLink {
  S r;
  Rates<S> r_rates;
  S C, S_;
  Rates<S> chi;
};

/// What moves a link against gravity: moment about its mass centre along x and y, force along x, r, t.
template <class S>
struct LinkLoad {
  S n_x, n_y, f_x, f_r, f_t;
};

/// I ω̇ + ω × I ω; of `principal` axes I is diagonal.
template <bool principal, class S>
Vector3<S> momentFor(const Matrix3<S>& I, const Vector3<S>& omega, const Vector3<S>& omega_dot) {
  if constexpr (principal) {
    const S &x = omega.x(), &y = omega.y(), &z = omega.z(), &I_x = I(0, 0), &I_y = I(1, 1), &I_z = I(2, 2);
    return {I_x * omega_dot.x() + (I_z - I_y) * (y * z), I_y * omega_dot.y() + (I_x - I_z) * (z * x),
            I_z * omega_dot.z() + (I_y - I_x) * (x * y)};
  } else {
    return I * omega_dot + omega.cross(Vector3<S>(I * omega));
  }
}

/// `base` is ä_O − g along x, y, z of the plane.
template <bool principal, class S>
LinkLoad<S> linkLoad(const S& mass, const Matrix3<S>& I, const OnLink<S>& at, const Rates<S>& alpha,
                     const Vector3<S>& base) {
  const S &C = at.C, &S_ = at.S_, &r = at.r, &chi = at.chi.dot;
  const S z = r * S_, z_dot = at.r_rates.dot * S_ + r * chi * C;
  const S b_z = base.z() - alpha.dot * alpha.dot * z;
  LinkLoad<S> out;
  out.f_x = mass * (base.x() - alpha.ddot * z - S(2) * alpha.dot * z_dot);                     // (a)
  out.f_r = mass * (at.r_rates.ddot - r * chi * chi + base.y() * C + b_z * S_);                // (a)
  out.f_t = mass * (r * at.chi.ddot + S(2) * at.r_rates.dot * chi - base.y() * S_ + b_z * C);  // (a)
  const Vector3<S> omega(chi, -alpha.dot * S_, -alpha.dot * C);                                // (b)
  const Vector3<S> omega_dot(at.chi.ddot, -alpha.ddot * S_ - alpha.dot * chi * C,
                             -alpha.ddot * C + alpha.dot * chi * S_);  // (b)
  const Vector3<S> n = momentFor<principal, S>(I, omega, omega_dot);
  out.n_x = n.x();
  out.n_y = S_ * n.y() + C * n.z();
  return out;
}

}  // namespace ursula::kernel
