#pragma once

#include <functional>
#include <vector>

#include "base/quintic_hermite.h"
#include "base/scalar.h"

namespace ursula {

/// A history of torques through samples: the quintic spline, four times continuously differentiable. Its error falls
/// with the sixth power of the step, which no cubic's does, and it is linear in the samples, so that errors of the
/// samples and of the interpolation simply add. At the ends its first two derivatives are those of the quintic through
/// the six outermost samples: of the same order, with no assumption on the motion.
class TorqueSpline {
 public:
  static constexpr std::size_t least_samples = 6;

  /// At least `least_samples`, at increasing instants.
  TorqueSpline(const std::vector<double>& t, const std::vector<Vector6d>& values);

  /// Does not allocate.
  Vector6d operator()(double t) const { return curve_.at(t).value; }

 private:
  QuinticHermite<double, motor_count> curve_;
};

/// Between each two instants, the largest 2-norm of `exact` less its own spline through these instants, N·m: the error
/// of interpolation alone, whatever the torques on trial.
///
/// The maximum over nine Chebyshev points, doubled: the error is to leading order a polynomial of sixth degree between
/// two samples, whose maximum is at most 1/cos(6π/(2·9)) = 2 times that (Ehlich and Zeller, 1964).
std::vector<double> interpolationErrors(const std::vector<double>& t, const std::function<Vector6d(double)>& exact);

/// Between each two instants, the largest 2-norm of the spline through torques of at most these 2-norms, N·m: how
/// errors of the samples show. By sums of |cardinal splines|, with the same nine points.
std::vector<double> carriedErrors(const std::vector<double>& t, const std::vector<double>& norms);

}  // namespace ursula
