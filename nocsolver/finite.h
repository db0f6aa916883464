#pragma once

#include <cstddef>

#include "model/motion.h"

namespace ursula {

/// Throws std::domain_error that names quantity and instant where one of `values` is infinite or NaN. Of several values
/// it says which, from 1.
void requireFinite(const double* values, std::size_t count, const char* what, double instant);

/// The same for all of the platform's motion.
void requireFinite(const Motion<double>& motion);

/// `values`, as it is.
template <class S>
const Vector6<S>& finite(const Vector6<S>& values, const char* what, const S& instant) {
  const Vector6<double> in_doubles = values.template cast<double>();
  requireFinite(in_doubles.data(), 6, what, static_cast<double>(instant));
  return values;
}

}  // namespace ursula
