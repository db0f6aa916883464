#pragma once

#include <cmath>
#include <limits>

namespace ursula {

/// Keeps the value with the largest share of its own limit. NaN has the largest share of all.
struct NearestToLimit {
  double value = 0, limit = 0, t = 0;
  int where = -1;  ///< −1 if nothing was compared

  void add(double new_value, double new_limit, double new_t, int new_where) {
    const double share = shareOf(new_value, new_limit);
    if (where >= 0 && !(share > shareOf(value, limit))) return;
    value = new_value, limit = new_limit, t = new_t, where = new_where;
  }

 private:
  static double shareOf(double value, double limit) {
    if (value == 0 && limit >= 0) return 0;  // the value 0 satisfies the limit 0
    const double share = value / limit;
    return std::isnan(share) ? std::numeric_limits<double>::infinity() : share;
  }
};

}  // namespace ursula
