#pragma once

// Mass matrices moved to P. Internal.

#include "base/scalar.h"

namespace ursula::kernel {

/// Adds a mass matrix at Bᵢ, in B, to one at P: Gᵀ M G with G = [−[Qb]×, 1].
template <class S>
void addAtP(const Matrix3<S>& M_B, const Vector3<S>& Qb, Matrix6<S>& M_P) {
  Matrix3<S> arm;
  arm << S(0), -Qb.z(), Qb.y(), Qb.z(), S(0), -Qb.x(), -Qb.y(), Qb.x(), S(0);
  const Matrix3<S> arm_M = arm * M_B;
  M_P.template topLeftCorner<3, 3>() -= arm_M * arm;
  M_P.template topRightCorner<3, 3>() += arm_M;
  M_P.template bottomLeftCorner<3, 3>() += arm_M.transpose();
  M_P.template bottomRightCorner<3, 3>() += M_B;
}

}  // namespace ursula::kernel
