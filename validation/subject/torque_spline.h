#pragma once

#include <functional>
#include <vector>

#include "base/quintic_spline.h"
#include "base/scalar.h"

namespace ursula {

/// A history of torques through samples: the quintic spline, four times continuously differentiable. Its error falls
/// with the sixth power of the step, unlike that of a cubic. It is linear in the samples, so errors of samples and
/// interpolation add. Its end derivatives are those of the quintic through the six outermost samples, which keeps the
/// order without assumptions.
class TorqueSpline {
 public:
  static constexpr std::size_t least_samples = 6;

  /// Needs at least `least_samples` values at increasing instants.
  TorqueSpline(const std::vector<double>& t, const std::vector<Vector6d>& values);

  /// Does not allocate.
  Vector6d operator()(double t) const { return curve_.at(t).value; }

 private:
  QuinticHermite<double, motor_count> curve_;
};

/// The largest 2-norm of `exact` minus its own spline through these instants, between each two instants, N·m. This is
/// the interpolation error, independent of the subject's torques.
///
/// It is twice the maximum over nine Chebyshev points. To leading order the error is a polynomial of sixth degree
/// between two samples, with a maximum of at most 1/cos(6π/(2·9)) = 2 times that (Ehlich and Zeller, 1964).
std::vector<double> interpolationErrors(const std::vector<double>& t, const std::function<Vector6d(double)>& exact);

/// The largest 2-norm, between each two instants, of the spline through torques bounded by these 2-norms, N·m. It is
/// the effect of errors in the samples: sums of |cardinal splines| at the same nine points.
std::vector<double> carriedErrors(const std::vector<double>& t, const std::vector<double>& norms);

}  // namespace ursula
