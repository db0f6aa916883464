#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scalar.h"

namespace ursula {

/// Whether `value` takes the place of `largest` in a search for the largest. NaN does, and stays.
inline bool exceeds(double value, double largest) { return !std::isnan(largest) && !(value <= largest); }

/// The value that a check shows out of many.
struct JudgedValue {
  double value = 0, limit = 0, t = 0;
  int where = -1;
  bool beyond = false;     ///< beyond its derived limit: a failure
  bool undecided = false;  ///< above the useful threshold and within its derived limit: undecidable
};

/// A check's summary of many instants: the value with the largest share of its limit, and the largest value. NaN
/// exceeds any limit and stays.
struct WorstShare {
  double value = 0, limit = 0, t = 0;
  int where = -1;    ///< leg or body, 0-based
  bool any = false;  ///< something was compared
  double largest = 0, largest_limit = 0, largest_t = 0;
  int largest_where = -1;
  double widest_limit = 0, widest_t = 0;  ///< the largest limit

  /// The share of the limit; 0 of 0 is 0, and NaN is infinite.
  static double share(double of_value, double of_limit) {
    if (of_value == 0 && of_limit >= 0) return 0;
    const double out = of_value / of_limit;
    return std::isnan(out) ? std::numeric_limits<double>::infinity() : out;
  }
  bool beyond() const { return !(value <= limit); }

  void add(double new_value, double new_limit, double new_t, int new_where = -1) {
    if (!any || exceeds(new_value, largest)) {
      largest = new_value;
      largest_limit = new_limit;
      largest_t = new_t;
      largest_where = new_where;
    }
    if (!any || exceeds(new_limit, widest_limit)) {
      widest_limit = new_limit;
      widest_t = new_t;
    }
    if (!any || (!std::isnan(value) && (std::isnan(new_value) || share(new_value, new_limit) > share(value, limit)))) {
      value = new_value;
      limit = new_limit;
      t = new_t;
      where = new_where;
    }
    any = true;
  }

  /// Adds the error of each motor or component, which has its own limit.
  void addEach(const Vector6d& errors, const Vector6d& limits, double new_t) {
    for (int i = 0; i < errors.size(); ++i) add(std::abs(errors(i)), limits(i), new_t, i);
  }

  /// Compares each value with its derived limit L and with `useful` U, above which a value matters. Beyond L it fails.
  /// Between U and L, or without L, it is undecidable. Within both it passes, and the smaller limit is shown.
  /// A failure shows the largest value if that is beyond its own limit.
  JudgedValue shown(double useful) const {
    if (!(largest <= largest_limit)) return {largest, largest_limit, largest_t, largest_where, true, false};
    if (beyond()) return {value, limit, t, where, true, false};
    if (!std::isfinite(widest_limit)) return {largest, widest_limit, widest_t, largest_where, false, true};
    if (!(largest <= useful)) return {largest, largest_limit, largest_t, largest_where, false, true};
    if (share(largest, useful) > share(value, limit)) return {largest, useful, largest_t, largest_where};
    return {value, std::min(limit, useful), t, where};
  }
};

}  // namespace ursula
