#pragma once

#include <cstring>

#include "model/joint_variables.h"

namespace ursula {

/// Whether all bits are equal: 0 is not −0, and NaN equals itself.
inline bool sameBits(const Vector6d& a, const Vector6d& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 6) == 0;
}
inline bool sameBits(const JointVariables<double>& a, const JointVariables<double>& b) {
  return sameBits(a.phi, b.phi) && sameBits(a.psi, b.psi) && sameBits(a.theta, b.theta) && sameBits(a.d, b.d);
}
inline bool sameBits(const JointMotion& a, const JointMotion& b) {
  return sameBits(a.q, b.q) && sameBits(a.q_dot, b.q_dot) && sameBits(a.q_ddot, b.q_ddot);
}

}  // namespace ursula
