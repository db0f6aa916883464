#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ursula {

/// Interpolates a history by polynomials of fifth degree through the six nearest instants, or by straight lines if
/// there are fewer. Beyond an end it keeps the last value. Refers to its arguments.
class HistoryLine {
 public:
  HistoryLine(const std::vector<double>& t, const std::vector<double>& values) : t_(t), values_(values) {}

  double at(double t) const {
    if (t <= t_.front()) return values_.front();
    if (t >= t_.back()) return values_.back();
    return t_.size() < 6 ? through(t, 2) : through(t, 6);
  }

  /// The least and the largest value of the line over [from, to]; NaN if one of them is NaN.
  std::pair<double, double> range(double from, double to) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    double low = at(from), high = low;
    const auto include = [&](double found) {
      low = std::isnan(found) || std::isnan(low) ? nan : std::min(low, found);
      high = std::isnan(low) ? low : std::max(high, found);
    };
    include(at(to));
    for (std::size_t i = before(from) + 1; i < t_.size() && t_[i] < to; ++i) include(values_[i]);
    return {low, high};
  }

  /// The distance of `value` from the line's range over [from, to]; NaN if the line or the value is NaN.
  double distance(double value, double from, double to) const {
    const auto [low, high] = range(from, to);
    if (std::isnan(low) || std::isnan(value)) return std::numeric_limits<double>::quiet_NaN();
    if (value >= low && value <= high) return 0;
    return value < low ? low - value : value - high;
  }

  /// The estimated interpolation error between two instants: the difference from a polynomial of two degrees less. For
  /// straight lines it is twice h²/8 times the second difference.
  double interpolationError(double t) const {
    if (isKnot(t) || t_.size() < 3) return 0;
    if (t_.size() >= 6) return std::abs(through(t, 6) - through(t, 4));
    return std::abs(through(t, 3) - through(t, 2)) * 2;
  }

  bool isKnot(double t) const {
    const std::size_t i = before(t);
    const double apart = i + 1 < t_.size() ? t_[i + 1] - t_[i] : std::numeric_limits<double>::infinity();
    const double rounding = std::min(4 * std::numeric_limits<double>::epsilon() * std::abs(t), apart / 4);
    return std::abs(t - t_[i]) <= rounding || (i + 1 < t_.size() && std::abs(t_[i + 1] - t) <= rounding);
  }

 private:
  /// Neville's scheme through the `count` instants around t; at an instant it returns the exact value.
  double through(double t, std::size_t count) const {
    const std::size_t i = before(t);
    if (t == t_[i]) return values_[i];
    const std::size_t left = i + 1 >= count / 2 ? i + 1 - count / 2 : 0;
    const std::size_t first = std::min(left, t_.size() - count);
    std::array<double, 6> p{};
    for (std::size_t k = 0; k < count; ++k) p[k] = values_[first + k];
    for (std::size_t m = 1; m < count; ++m)
      for (std::size_t k = 0; k + m < count; ++k) {
        const double near = t_[first + k], far = t_[first + k + m];
        p[k] += (t - near) / (far - near) * (p[k + 1] - p[k]);
      }
    return p[0];
  }

  std::size_t before(double t) const {
    const auto after = std::upper_bound(t_.begin(), t_.end(), t) - t_.begin();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
  }

  const std::vector<double>& t_;
  const std::vector<double>& values_;
};

}  // namespace ursula
