#pragma once

#include <Eigen/Geometry>

#include "base/scalar.h"

namespace ursula {

/// (paper, eqs. 2a, 2b) in a form valid for any tilt: x̂ = (u × e_z)/‖·‖, ŷ = u, ẑ = x̂ × u; for an axis along e_z, e_y
/// replaces e_z.
template <class S, class Written>
void setFixedFrame(const Vector3<Written>& axis, Vector3<S>& x_hat, Vector3<S>& y_hat, Vector3<S>& z_hat) {
  using std::sqrt;
  const Vector3<S> u = axis.template cast<S>() / sqrt(axis.template cast<S>().squaredNorm());
  const Vector3<S> e_z = Vector3<S>::UnitZ();
  // Below this, the cross product would consist of rounding errors of the given uᵢ.
  const bool along_e_z = u.cross(e_z).squaredNorm() < S(1e-20);
  const Vector3<S> seed = along_e_z ? Vector3<S>::UnitY() : e_z;
  const Vector3<S> x = u.cross(seed);
  y_hat = u;
  x_hat = x / sqrt(x.squaredNorm());
  z_hat = x_hat.cross(u);
}

}  // namespace ursula
