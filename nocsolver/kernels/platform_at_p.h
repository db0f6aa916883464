#pragma once

// What the solvers share of the platform: the factors of B, and mass matrices brought to P. Internal.

#include <Eigen/LU>

#include "model/scalar.h"
#include "nocsolver/errors.h"

namespace ursula::kernel {

/// Of the pivots of Bᵀ, its moment rows over a length of the machine, the smallest over the largest. Throws
/// SingularJacobian.
template <class S>
void requireRegularB(const S& ratio, const S& t) {
  const S bound = S(16) * Eigen::NumTraits<S>::epsilon();
  if (!(ratio > bound))
    throw SingularJacobian("B is singular, its smallest pivot over its largest", -1, static_cast<double>(t),
                           static_cast<double>(ratio), static_cast<double>(bound), "");
}

/// Factors of Bᵀ, its moment rows over `length`. Throws SingularJacobian.
template <class S>
void factorise(const Matrix6<S>& B, const S& length, const S& t, Eigen::PartialPivLU<Matrix6<S>>& B_transposed) {
  // Moments over a length of the machine, so that the pivots do not depend on the unit of length.
  Matrix6<S> scaled = B.transpose();
  scaled.template topRows<3>() /= length;
  B_transposed.compute(scaled);
  const auto pivots = B_transposed.matrixLU().diagonal().cwiseAbs();
  requireRegularB<S>(pivots.minCoeff() / pivots.maxCoeff(), t);
}

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
