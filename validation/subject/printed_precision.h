#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace ursula {

/// The precision of a printed file: its most decimals and its most significant digits. See TorqueFile.
class PrintedPrecision {
 public:
  /// `place` is the power of ten of the last digit printed.
  void add(double value, int place) {
    last_place_ = std::min(last_place_, place);
    if (value != 0) digits_ = std::max(digits_, firstPlace(value) - place + 1);
  }

  /// Half a unit of the last digit that the file's writer could have printed.
  double of(double value, int place) const {
    const int by_digits = value == 0 ? last_place_ : firstPlace(value) - digits_ + 1;
    const double half = 0.5 * std::pow(10.0, std::min(place, std::max(last_place_, by_digits)));
    return half > std::numeric_limits<double>::epsilon() * std::abs(value) ? half : 0;  // finer than a double: exact
  }
  int digits() const { return digits_; }

 private:
  /// The power of ten of the first significant digit.
  static int firstPlace(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

  int last_place_ = std::numeric_limits<int>::max();
  int digits_ = 0;
};

}  // namespace ursula
