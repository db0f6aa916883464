#pragma once

#include <Eigen/Core>

namespace ursula {

/// The largest number of legs; the paper's machine has it.
constexpr int leg_count = 6;
constexpr int motor_count = 6;
/// Two links per leg and the platform, ordered as in (30a): proximal links, distal links, platform. The places of legs
/// that a machine lacks stay empty.
constexpr int body_count = 2 * leg_count + 1;

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
/// Six-vectors are [ω; v] or [n; f], as in the paper.
template <class S>
using Vector6 = Eigen::Matrix<S, 6, 1>;
template <class S>
using Matrix6 = Eigen::Matrix<S, 6, 6>;

using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using Vector6d = Vector6<double>;
using Matrix6d = Matrix6<double>;

}  // namespace ursula
