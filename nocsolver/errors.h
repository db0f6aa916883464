#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "model/motion.h"

namespace ursula {

/// A pose at which the formulas do not hold, with the leg, the instant, and the number that is out of bounds.
class PoseError : public std::runtime_error {
 public:
  /// `leg` is 0-based, or −1 if no single leg causes it; `instant` is in s. The pose is refused because `measure` is
  /// outside `bound`, both in `unit`.
  PoseError(const std::string& what, int leg, double instant, double measure, double bound, const std::string& unit);

  int leg() const { return leg_; }
  double instant() const { return instant_; }
  double measure() const { return measure_; }
  double bound() const { return bound_; }

 private:
  int leg_;
  double instant_, measure_, bound_;
};

/// ‖AᵢBᵢ‖ is above l + s or below |l − s|, or the like for other kinds of legs; measure is the distance, m.
class OutOfReach : public PoseError {
 public:
  using PoseError::PoseError;
};

/// The rod of a UPS leg leaves its cylinder or strikes its end; measure is d, m.
class OutOfStroke : public OutOfReach {
 public:
  using OutOfReach::OutOfReach;
};

/// sin θ vanishes (for RUS sin ψ or cos θ, for PUS cos θ). The leg is stretched or folded and its rates are
/// undetermined; measure is its absolute value.
class StretchedLeg : public PoseError {
  using PoseError::PoseError;
};

/// B lies on the leg's first axis, so φ is undetermined; measure is the distance from the axis, m.
class PointOnAxis : public PoseError {
  using PoseError::PoseError;
};

/// B of (23) is singular: the actuators do not determine the platform's twist; measure is the pivot ratio.
class SingularJacobian : public PoseError {
  using PoseError::PoseError;
};

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
