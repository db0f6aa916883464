#pragma once

#include <stdexcept>
#include <string>

namespace ursula {

/// A pose at which the formulas do not hold: names the leg, the instant and the number that tells how near it is.
class PoseError : public std::runtime_error {
 public:
  /// `leg` is 0-based, −1 where no single leg is to blame; `instant` in s; the pose is refused since `measure` is
  /// outside of `bound`, both in `unit`.
  PoseError(const std::string& what, int leg, double instant, double measure, double bound, const std::string& unit);

  int leg() const { return leg_; }
  double instant() const { return instant_; }
  double measure() const { return measure_; }
  double bound() const { return bound_; }

 private:
  int leg_;
  double instant_, measure_, bound_;
};

/// ‖AᵢBᵢ‖ is above l + s or below |l − s|, or what is like it for other kinds of legs; measure is the distance, m.
class OutOfReach : public PoseError {
 public:
  using PoseError::PoseError;
};

/// The rod of a UPS leg leaves its cylinder or strikes its end; measure is d, m.
class OutOfStroke : public OutOfReach {
 public:
  using OutOfReach::OutOfReach;
};

/// sin θ vanishes (of RUS sin ψ or cos θ, of PUS cos θ): the leg is stretched or folded and its rates are not
/// determined; measure is its size.
class StretchedLeg : public PoseError {
  using PoseError::PoseError;
};

/// B lies on the leg's actuated axis: φ is not determined; measure is the distance from the axis, m.
class PointOnAxis : public PoseError {
  using PoseError::PoseError;
};

/// B of (23) is singular: the actuators do not determine the platform's twist; measure is the pivot ratio.
class SingularJacobian : public PoseError {
  using PoseError::PoseError;
};

}  // namespace ursula
