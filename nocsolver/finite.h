#pragma once

#include <cstddef>

#include "model/motion.h"

namespace ursula {

/// Throws std::domain_error with quantity and instant if one of `values` is infinite or NaN. Of several values it names
/// the 1-based index.
void requireFinite(const double* values, std::size_t count, const char* what, double instant);

/// The same for the platform's whole motion.
void requireFinite(const Motion<double>& motion);

/// Returns `values` unchanged if they are finite.
template <class S>
const Vector6<S>& finite(const Vector6<S>& values, const char* what, const S& instant) {
  const Vector6<double> in_doubles = values.template cast<double>();
  requireFinite(in_doubles.data(), 6, what, static_cast<double>(instant));
  return values;
}

}  // namespace ursula
