#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "base/scalar.h"

namespace ursula {

/// Random numbers independent of the standard library's distributions: equal everywhere for equal seeds. No expression
/// may draw twice if the language leaves its order to the compiler.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// Uniform in the logarithm.
  double spread(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double sign() { return chance(0.5) ? 1 : -1; }
  /// From low to high, both included.
  int whole(int low, int high) { return low + static_cast<int>(uniform(0, 1) * (high - low + 1)); }
  /// Either sign, with a size uniform in the logarithm.
  double spreadOfEitherSign(double low, double high) {
    const double side = sign();
    return side * spread(low, high);
  }
  /// One of the first `count` values of an enumeration.
  template <class Choice>
  Choice pick(int count) {
    return static_cast<Choice>(whole(0, count - 1));
  }

  Vector3d vector(double size) { return vector(-size, size); }
  Vector3d vector(double low, double high) {
    const double x = uniform(low, high), y = uniform(low, high);
    return {x, y, uniform(low, high)};
  }
  /// Uniform on the sphere.
  Vector3d direction() {
    while (true) {
      const Vector3d v = vector(1);
      const double norm = v.norm();
      if (norm > 0.1 && norm <= 1) return v / norm;
    }
  }
  Eigen::Quaterniond turn(double largest) {
    const double angle = uniform(0, largest);
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, direction()));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace ursula
