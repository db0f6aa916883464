#pragma once

namespace ursula {

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;  ///< in rad
constexpr double degrees_per_radian = 180 / pi;

}  // namespace ursula
