#pragma once

#include <cmath>

namespace ursula {

/// The larger of two; NaN wins, so that it is seen.
inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// What a check shows of many instants: the one furthest beyond its limit, or where none is, the largest value. NaN is
/// beyond any limit and stays.
struct Worst {
  double value = 0, limit = 0, t = 0;
  int where = -1;       ///< leg or body, 0-based
  bool beyond = false;  ///< value > limit, or NaN
  bool any = false;     ///< something was compared

  void add(double new_value, double new_limit, double new_t, int new_where = -1) {
    const bool new_beyond = !(new_value <= new_limit);
    const bool isWorse = !any                   ? true
                         : new_beyond != beyond ? new_beyond
                         : new_beyond ? !std::isnan(value / limit) && !(new_value / new_limit <= value / limit)
                                      : new_value >= value;
    if (isWorse) *this = {new_value, new_limit, new_t, new_where, new_beyond, true};
  }
};

}  // namespace ursula
