#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/exact_trajectory.h"
#include "model/trajectory.h"

namespace ursula {

/// Largest mismatches, over the given instants, of a trajectory's velocities and accelerations with derivatives of its
/// pose.
struct DerivativeMismatch {
  double omega = 0, omega_dot = 0, p_dot = 0, p_ddot = 0;
  double worst() const { return std::max({omega, omega_dot, p_dot, p_ddot}); }
};

/// Step of the central differences; they are off by h²/6 times a third derivative, so by 2e-25 times that.
inline const Real50 difference_step("1e-12");
/// Allows for third derivatives up to 5e6 (those of the tested motions are below 1e4), and is far below a double's eps.
constexpr double difference_tolerance = 1e-18;

template <class V>
V centralDifference(const V& before, const V& after) {
  return (after - before) / (2 * difference_step);
}

/// In 50 digits: ω from (dQ/dt) Qᵀ, the others from the derivatives one order lower.
inline DerivativeMismatch derivativeMismatch(const Trajectory& trajectory, const std::vector<double>& instants) {
  DerivativeMismatch mismatch;
  const auto widen = [](double& worst, const Vector3<Real50>& a, const Vector3<Real50>& b) {
    const double error = (a - b).norm().convert_to<double>();
    worst = error <= worst ? worst : error;  // keeps a NaN
  };
  for (const double instant : instants) {
    const Real50 t(instant);
    const Motion<Real50> before = trajectory.at(Real50(t - difference_step));
    const Motion<Real50> now = trajectory.at(t);
    const Motion<Real50> after = trajectory.at(Real50(t + difference_step));
    const Matrix3<Real50> spin = centralDifference(before.Q, after.Q) * now.Q.transpose();
    widen(mismatch.omega, now.omega, Vector3<Real50>(spin(2, 1), spin(0, 2), spin(1, 0)));
    widen(mismatch.omega_dot, now.omega_dot, centralDifference(before.omega, after.omega));
    widen(mismatch.p_dot, now.p_dot, centralDifference(before.p, after.p));
    widen(mismatch.p_ddot, now.p_ddot, centralDifference(before.p_dot, after.p_dot));
  }
  return mismatch;
}

/// `count` instants inside (0, duration), none at a round fraction of it, where a knot may be.
inline std::vector<double> instantsInside(double duration, int count) {
  std::vector<double> instants;
  for (int i = 0; i < count; ++i) instants.push_back(duration * (i + 0.381966) / count);
  return instants;
}

/// The largest entry of QᵀQ − 1, or 2 if Q is a reflection.
template <class S>
double orthonormalityError(const Matrix3<S>& Q) {
  const Matrix3<S> product = Q.transpose() * Q - Matrix3<S>::Identity();
  const S handedness = Q.col(0).cross(Q.col(1)).dot(Q.col(2));
  return handedness > 0 ? static_cast<double>(product.cwiseAbs().maxCoeff()) : 2.0;
}

/// The largest difference between the kernels in doubles and in 50 digits, over the quantity's size in the whole
/// motion.
inline double roundingError(const Trajectory& trajectory, const std::vector<double>& instants) {
  double scale[6] = {1, 1, 1, 1, 1, 1}, error[6] = {};
  for (const double t : instants) {
    const Motion<double> rounded = trajectory.at(t);
    const Motion<Real50> exact = trajectory.at(Real50(t));
    const auto note = [&](int i, const auto& a, const auto& b) {
      scale[i] = std::max(scale[i], a.cwiseAbs().maxCoeff());
      const double off = (a.template cast<Real50>() - b).cwiseAbs().maxCoeff().template convert_to<double>();
      error[i] = off <= error[i] ? error[i] : off;
    };
    note(0, rounded.p, exact.p);
    note(1, rounded.p_dot, exact.p_dot);
    note(2, rounded.p_ddot, exact.p_ddot);
    note(3, rounded.Q, exact.Q);
    note(4, rounded.omega, exact.omega);
    note(5, rounded.omega_dot, exact.omega_dot);
  }
  double worst = 0;
  for (int i = 0; i < 6; ++i) worst = error[i] / scale[i] <= worst ? worst : error[i] / scale[i];
  return worst;
}

/// A trajectory with an error in one derivative, which a check must catch.
class Falsified : public ExactTrajectory {
 public:
  enum class Part { omega, omega_dot, p_dot, p_ddot };
  Falsified(const Trajectory& truth, Part part, double error) : truth_(truth), part_(part), error_(error) {}
  std::string kind() const override { return truth_.kind(); }
  double duration() const override { return truth_.duration(); }
  Motion<double> at(double t) const override { return falsified(truth_.at(t)); }
  Motion<Real50> at(const Real50& t) const override { return falsified(truth_.at(t)); }

 private:
  /// The error grows with t, so that the falsified quantity's derivative is wrong, too.
  template <class S>
  Motion<S> falsified(Motion<S> motion) const {
    const S error = S(error_) * (1 + motion.t);
    if (part_ == Part::omega) motion.omega.x() += error;
    if (part_ == Part::omega_dot) motion.omega_dot.y() += error;
    if (part_ == Part::p_dot) motion.p_dot.z() += error;
    if (part_ == Part::p_ddot) motion.p_ddot.x() += error;
    return motion;
  }

  const Trajectory& truth_;
  Part part_;
  double error_;
};

}  // namespace ursula
