#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "nocsolver/poses/ups_poses_roots.h"

// Newton's method on |p + Qb − a|² = d², over the real or the complex numbers. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Vec6 = Eigen::Matrix<Scalar, 6, 1>;
template <class Scalar>
using Mat3 = Eigen::Matrix<Scalar, 3, 3>;

/// xᵀy and x × y without conjugation; Eigen's own functions conjugate.
template <class X, class Y>
typename X::Scalar product(const X& x, const Y& y) {
  return (x.transpose() * y).value();
}
template <class Scalar>
Vec3<Scalar> crossed(const Vec3<Scalar>& x, const Vec3<Scalar>& y) {
  return {x(1) * y(2) - x(2) * y(1), x(2) * y(0) - x(0) * y(2), x(0) * y(1) - x(1) * y(0)};
}

/// Q of a quaternion with qᵀq = 1.
template <class Scalar>
Mat3<Scalar> rotation(const Eigen::Matrix<Scalar, 4, 1>& q) {
  const Scalar w = q(0), x = q(1), y = q(2), z = q(3), two = 2;
  Mat3<Scalar> Q;
  Q << w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y),  //
      two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x),   //
      two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z;
  return Q;
}

/// The six equations at a pose.
template <class Scalar>
struct Equations {
  Vec6<Scalar> f;                 ///< vᵀv − d², v = p + Qb − a
  Eigen::Matrix<Scalar, 6, 6> J;  ///< derivatives by a rotation about the axes of B, then by p
  double rounding = 0;            ///< error bound of f: some 16 roundings of its largest terms
  double curvature = 0;           ///< bound of |½ f''| for a unit step
  bool solved() const { return f.cwiseAbs().maxCoeff() <= rounding; }
};

template <class Scalar, class LegScalar>
Equations<Scalar> equations(const LegsOver<LegScalar>& legs, const Placed<Scalar>& at) {
  Equations<Scalar> out;
  const Mat3<Scalar> Q = rotation<Scalar>(at.q);
  double largest = 0;
  for (int k = 0; k < 6; ++k) {
    const auto leg = static_cast<std::size_t>(k);
    const Vec3<Scalar> Qb = Q * legs.b[leg].template cast<Scalar>(),
                       v = at.p + Qb - legs.a[leg].template cast<Scalar>();
    out.f(k) = product(v, v) - Scalar(legs.d(k) * legs.d(k));
    out.J.row(k) << 2.0 * crossed<Scalar>(Qb, v).transpose(), 2.0 * v.transpose();
    const double terms = at.p.norm() + Q.norm() * legs.b[leg].norm() + legs.a[leg].norm() + std::abs(legs.d(k));
    largest = std::max(largest, terms * terms);
    out.curvature = std::max(out.curvature, (1 + Qb.norm()) * (1 + Qb.norm()) + v.norm() * Qb.norm());
  }
  out.rounding = 16 * Eigen::NumTraits<double>::epsilon() * largest;
  return out;
}

/// Rotates, then translates.
template <class Scalar>
Placed<Scalar> displaced(const Placed<Scalar>& from, const Vec6<Scalar>& step) {
  const Vec3<Scalar> half = step.template head<3>() / 2.0, v = from.q.template tail<3>();
  Placed<Scalar> to = from;
  to.q(0) -= product(half, v);
  to.q.template tail<3>() += from.q(0) * half + crossed<Scalar>(half, v);
  to.q /= std::sqrt(product(to.q, to.q));
  to.p += step.template tail<3>();
  return to;
}

/// Newton's method until f no longer falls; keeps the best pose. Returns whether it is a solution.
template <class Scalar>
bool polish(const Legs& legs, Placed<Scalar>& pose) {
  constexpr int steps = 12, patience = 3;
  Equations<Scalar> now = equations<Scalar>(legs, pose);
  double best = now.f.norm();
  bool solved = now.solved();
  Placed<Scalar> next = pose;
  for (int i = 0, worse = 0; i < steps && worse < patience && best > 0; ++i) {
    next = displaced<Scalar>(next, -now.J.partialPivLu().solve(now.f));
    now = equations<Scalar>(legs, next);
    const double value = now.f.norm();
    if (!(value < best)) {
      if (solved) break;
      ++worse;
      continue;
    }
    worse = 0;
    best = value;
    pose = next;
    solved = now.solved();
  }
  return solved;
}

}  // namespace ursula::ups
