#pragma once

#include <algorithm>

#include "nocsolver/noc/noc.h"

namespace ursula {

/// Rounding errors on the longest chain of dependent operations. There is one per body and per pivot on either side of
/// a comparison, 2 (13 + 6), rounded up to a power of two.
constexpr double chain_length = 64;

/// The amplification of a relative error of the motion or of a parameter on its way to rates and torques. It is the
/// condition number of B (moments over a length of the machine; Frobenius norms bound the spectral ones) times that of
/// the worst leg, whose rates contain 1/sin θ and q/r. Needs inverseKinematics and jacobians.
template <class S>
S conditionNumber(const Noc<S>& solver, const NocWorkspace<S>& work) {
  Matrix6<S> B = work.B;
  B.template leftCols<3>() /= solver.machine().length;
  const Matrix6<S> inverse = B.inverse();
  S legs = 1;
  for (const LegState<S>& leg : work.legs)
    legs = std::max<S>(legs, leg.margins.leverage * leg.margins.leverage / (leg.margins.sine * leg.margins.sine));
  return B.norm() * inverse.norm() * legs;
}

/// Relative rounding error that either of two formulations to the same number may have at the motion in `work`.
template <class S>
double roundingLimit(const Noc<S>& solver, const NocWorkspace<S>& work) {
  return static_cast<double>(S(chain_length * Eigen::NumTraits<S>::epsilon() * conditionNumber(solver, work)));
}

}  // namespace ursula
