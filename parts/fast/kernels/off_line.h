#pragma once

// Terms of mass centres off their links' lines, added to the kinds' forces and mass matrices. Internal.
//
// The kinds place each mass m at ρ from the first end on the line. Let o lead from there to the mass centre. b is
// the point's acceleration minus g; V and W are the partial velocities of the point and of the link's ω:
//   Q = Vᵀ m a_o + Wᵀ (o × m (b + a_o)),  a_o = ω̇ × o + ω × (ω × o)                                             (a)
//   M = m (VᵀU + UᵀV + UᵀU),  the columns of U those of W each × o                                             (b)
// All vectors are along x, u, z of the leg's plane (for RUS the rod's). There ω̇ is W q̈ plus the term from the
// rotation of x.

#include <Eigen/Geometry>
#include <array>

#include "parts/fast/kernels/plane_leg.h"

namespace ursula::kernel {

template <class S>
struct OffLink {
  S mass;
  Vector3<S> o, omega, omega_dot, b;
  Matrix3<S> W, V;
};

/// W, and ω with its rate.
template <class S>
struct OffTurn {
  Matrix3<S> W;
  Vector3<S> omega, omega_dot;
};

/// `before` is the motion of the link's first end: b and V. The link's frame is [x, r × x, r].
template <class S>
struct OffEnd {
  Vector3<S> b;
  Matrix3<S> V;

  OffEnd along(const OffTurn<S>& turn, const Vector3<S>& arm) const {
    OffEnd out{b + turn.omega_dot.cross(arm) + turn.omega.cross(turn.omega.cross(arm)), V};
    for (int j = 0; j < 3; ++j) out.V.col(j) += Vector3<S>(turn.W.col(j)).cross(arm);
    return out;
  }
  OffLink<S> link(const S& mass, const Vector3<S>& off, const Vector3<S>& x, const Vector3<S>& r, const S& distance,
                  const OffTurn<S>& turn) const {
    const OffEnd at = along(turn, distance * r);
    return {mass, off.x() * x + off.y() * r.cross(x), turn.omega, turn.omega_dot, at.b, turn.W, at.V};
  }
};

/// The columns of W are multiples of −u and x; the rotation of x adds a term to ω̇ along z.
template <class S>
OffTurn<S> offTurn(const PlaneLeg<S>& leg, const Vector3<S>& about_minus_u, const Vector3<S>& about_x) {
  OffTurn<S> out;
  out.W << about_x.transpose(), -about_minus_u.transpose(), Vector3<S>::Zero().transpose();
  out.omega = out.W * leg.rate;
  out.omega_dot = out.W * leg.acceleration;
  out.omega_dot.z() -= out.omega.x() * out.omega.y();  // ẋ = −α̇ u × x = α̇ z
  return out;
}

template <class S>
using OffLinks = std::array<OffLink<S>, 2>;

}  // namespace ursula::kernel
