#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/csv_digits.h"

namespace ursula {

/// Tells whether numbers are those of single precision, in whatever digits these were printed: each number is what its
/// nearest 24-bit number prints as, with so many digits. Numbers of few digits all are, and tell nothing.
class SinglePrecision {
 public:
  void add(double value) {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    if (!is_single_ || value == 0) return;
    const auto single = static_cast<float>(value);
    const double unit = std::pow(10.0, lastPlace(fmt::format("{}", value)));
    is_single_ = std::abs(static_cast<double>(single) - value) <= 0.5 * unit + eps * std::abs(value);
    const double spacing = std::nextafter(std::abs(single), std::numeric_limits<float>::infinity()) - std::abs(single);
    if (is_single_ && spacing > unit) told_ += std::log2(spacing / unit);
  }

  /// Whether all are, and other numbers with as many digits would be by less than one chance in a million.
  bool all() const { return is_single_ && told_ > 20; }

 private:
  bool is_single_ = true;
  double told_ = 0;  ///< bits
};

}  // namespace ursula
