#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ursula {

/// The largest number of legs; the paper's machine has it.
constexpr int leg_count = 6;
constexpr int motor_count = 6;
/// Two links per leg and the platform, ordered as in (30a): proximal links, distal links, platform. The places of legs
/// that a machine lacks stay empty.
constexpr int body_count = 2 * leg_count + 1;

/// One value for each leg, motor or body, by its number.
template <class T>
using PerLeg = std::array<T, leg_count>;
template <class T>
using PerMotor = std::array<T, motor_count>;
template <class T>
using PerBody = std::array<T, body_count>;

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

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;  ///< in rad
constexpr double degrees_per_radian = 180 / pi;

/// Returns the angle between sides a and b of a triangle, opposite to c. It is exact to rounding even for needles
/// (Kahan, Miscalculating Area and Angles of a Needle-like Triangle, 2014, sect. 2).
inline double angleOpposite(double c, double a, double b) {
  if (a < b) std::swap(a, b);
  const double slack = b >= c ? c - (a - b) : b - (a - c);
  const double top = ((a - b) + c) * slack, bottom = (a + (b + c)) * ((a - c) + b);
  return 2 * std::atan2(std::sqrt(std::max(top, 0.0)), std::sqrt(std::max(bottom, 0.0)));
}

/// Returns the larger of two; NaN wins.
inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

}  // namespace ursula
