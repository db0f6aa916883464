#pragma once

#include <functional>
#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"

namespace ursula {

/// How far deviations may grow within one window of the motion that starts on the commanded state.
struct GrowthWindow {
  std::vector<double> t;                  ///< instants, s
  std::vector<double> from_acceleration;  ///< position bound for the acceleration errors given, m
  std::vector<double> from_unit_rate;     ///< for errors of 1 (m and m/s) a second in every coordinate, m
  std::vector<double> from_start;         ///< ‖∂position/∂state‖ from the window's start
  std::vector<double> growth;             ///< ‖∂position/∂velocity‖ from the window's start, s
  std::size_t last = 0;                   ///< index of its last instant along the whole motion
  double length = 0;                      ///< of the machine, m

  double start() const { return t.front(); }
  double end() const { return t.back(); }
  /// Bound at `at` for errors of `rate` a second and of `initial` at the start, in every coordinate: the larger of the
  /// two instants beside it. m
  double bound(double at, double rate, double initial) const;
};

/// How deviations grow along the commanded motion, by the variational equations of (36) with the torques held as
/// functions of time. State: [δp; L δϑ; δṗ; L δω] of the platform in m and m/s, L a length of the machine, so that one
/// number bounds position and orientation. Always from the formulas that hold.
class Amplification {
 public:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  using Vector12 = Eigen::Matrix<double, 12, 1>;

  /// Linearises the direct dynamics at 2 `intervals` + 1 instants of the motion. Throws PoseError where it is singular.
  Amplification(const Scenario& scenario, int intervals);

  /// The longest window from instant `first` on in which the bound stays below `useful` for acceleration errors of
  /// `acceleration(t)` m/s² and `rate` a second; at least one interval. All errors are taken as aligned for the worst.
  GrowthWindow window(std::size_t first, const std::function<double(double)>& acceleration, double rate,
                      double useful) const;

  /// The deviation at `end` of a motion that starts on the path at `start` and whose acceleration [p̈; L ω̇] is off by
  /// `error(t)`: ∫ Φ(end, s) [0; error(s)] ds. Both are taken to the nearest instants.
  Vector12 carried(double start, double end, const std::function<Vector6d(double)>& error) const;
  /// A bound of its position where only the error's size is known: ∫ ‖Φ‖ size(s) ds.
  double carriedBound(double start, double end, const std::function<double(double)>& size) const;

  const std::vector<double>& instants() const { return instants_; }
  double length() const { return length_; }
  /// How fast deviations grow about t, or would without friction: the largest real part of an eigenvalue λ of the
  /// linearised motion, or of its part λ² = ∂p̈/∂p, the larger of the two instants beside t that were looked at, at
  /// least 0. 1/s.
  double growthRate(double t) const;
  /// How fast deviations decay at most, the median over the motion: where that is large, friction makes the equations
  /// stiff. 1/s.
  double decayRate() const;

 private:
  class Carried;
  std::size_t nearest(double t) const;

  std::vector<double> instants_;
  /// From instant k to k + 1.
  const Matrix12& propagator(std::size_t k) const { return propagators_[uniform_ ? 0 : k]; }
  std::size_t intervals() const { return instants_.size() - 1; }

  bool uniform_ = true;  ///< a pose is held: all propagators are the same, and there is but one
  std::vector<Matrix12> propagators_;
  double length_ = 1;
  std::vector<double> growth_rates_, decay_rates_;  ///< at every growth_stride-th instant, and the last
};

}  // namespace ursula
