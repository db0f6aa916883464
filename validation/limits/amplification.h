#pragma once

#include <functional>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// Bounds on the growth of deviations in one window of the motion that starts on the commanded state.
struct GrowthWindow {
  std::vector<double> t;                  ///< instants, s
  std::vector<double> from_acceleration;  ///< position bound for the given acceleration errors, m
  std::vector<double> from_unit_rate;     ///< for errors of 1 (m and m/s) per second in every coordinate, m
  std::vector<double> from_start;         ///< ‖∂position/∂state‖ from the window's start
  std::vector<double> growth;             ///< ‖∂position/∂velocity‖ from the window's start, s
  std::size_t last = 0;                   ///< index of its last instant in the whole motion
  double length = 0;                      ///< length of the machine, m

  double start() const { return t.front(); }
  double end() const { return t.back(); }
  /// The bound at `at`, m, for errors of `rate` per second and of `initial` at the start, in every coordinate. It is
  /// the larger of the values at the two neighbouring instants.
  double bound(double at, double rate, double initial) const;
};

/// Growth of deviations along the commanded motion, by the variational equations of (36) with torques as given
/// functions of time. The state is [δp; L δϑ; δṗ; L δω] of the platform in m and m/s. L is a length of the machine, so
/// one number bounds position and orientation. It always uses the correct formulas.
class Amplification {
 public:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  using Vector12 = Eigen::Matrix<double, 12, 1>;

  /// Linearises the direct dynamics at 2 `intervals` + 1 instants of the motion. Throws PoseError at a singular pose.
  Amplification(const Scenario& scenario, int intervals, const Deadline& deadline = {});

  /// The longest window from instant `first` in which the bound stays below `useful`; at least one interval. Errors are
  /// `acceleration(t)` m/s² and `rate` per second, all in the worst direction. The work grows with the square of a
  /// window's intervals, so it has at most longestWindow() of them.
  GrowthWindow window(std::size_t first, const std::function<double(double)>& acceleration, double rate, double useful,
                      const Deadline& deadline = {}) const;
  /// The windows of the whole motion then take a bounded number of matrix products, some seconds.
  std::size_t longestWindow() const;

  /// The deviation at `end` of a motion that starts on the path at `start` with an acceleration error [p̈; L ω̇] of
  /// `error(t)`: ∫ Φ(end, s) [0; error(s)] ds. Both times are rounded to the nearest instants.
  Vector12 carried(double start, double end, const std::function<Vector6d(double)>& error) const;
  /// A bound of its position if only the error's size is known: ∫ ‖Φ‖ size(s) ds.
  double carriedBound(double start, double end, const std::function<double(double)>& size) const;

  const std::vector<double>& instants() const { return instants_; }
  double length() const { return length_; }
  /// The growth rate of deviations about t, or that without friction, 1/s, at least 0. It is the largest real part of
  /// an eigenvalue λ of the linearised motion, or of its part λ² = ∂p̈/∂p. It is the larger value at the two evaluated
  /// instants beside t.
  double growthRate(double t) const;
  /// The fastest decay rate of deviations, the median over the motion, 1/s. A large value means that friction makes the
  /// equations stiff.
  double decayRate() const;

 private:
  class CarriedDeviation;
  std::size_t nearest(double t) const;

  std::vector<double> instants_;
  /// From instant k to k + 1.
  const Matrix12& propagator(std::size_t k) const { return propagators_[uniform_ ? 0 : k]; }
  std::size_t intervals() const { return instants_.size() - 1; }

  bool uniform_ = true;  ///< a held pose has equal propagators, so one is stored
  std::vector<Matrix12> propagators_;
  double length_ = 1;
  std::vector<double> growth_rates_, decay_rates_;  ///< at every growth_stride-th instant, and the last
};

}  // namespace ursula
