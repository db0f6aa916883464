#pragma once

#include "base/scalar.h"

// What (29) says of one body; for the paper's machine and for any mechanism.

namespace ursula {

/// M x of (29), for a tensor about the mass centre in the axes of x.
template <class S>
Vector6<S> timesM(const Matrix3<S>& I, const S& mass, const Vector6<S>& x) {
  Vector6<S> out;
  out << I * x.template head<3>(), mass * x.template tail<3>();  // (paper, eq. 29)
  return out;
}

/// W x of (29).
template <class S>
Vector6<S> timesW(const Vector3<S>& omega, const Vector6<S>& x) {
  Vector6<S> out = Vector6<S>::Zero();
  out.template head<3>() = omega.cross(Vector3<S>(x.template head<3>()));  // (paper, eq. 29)
  return out;
}

}  // namespace ursula
