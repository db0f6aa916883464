#include "validation/limits/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "model/instants.h"

namespace ursula {
namespace {

using Matrix12 = Linearisation::Matrix12;

/// Of an interval's propagator, what halving may change.
constexpr double resolved = 1e-7;
/// Halvings of one interval, and of all: beyond, what is left shows in what halving changes.
constexpr int deepest = 16, most_halvings = 2000;
/// A joint's speed may change by this share of its smoothing speed within an interval.
constexpr double smooth_change = 0.5;
/// A joint whose speed is above this many smoothing speeds throughout rubs as if it were constant.
constexpr double saturated = 20;

/// Magnus' expansion to fourth order by Gauss' two points (Blanes, Casas, Oteo, Ros, Phys. Rep. 470 (2009) 151), which
/// strong friction does not make unstable.
Matrix12 propagator(const Linearisation& linear, double from, double to) {
  const double h = to - from, middle = (from + to) / 2, gauss = std::sqrt(3.0) / 6 * h;
  const Matrix12 J1 = linear.at(middle - gauss), J2 = linear.at(middle + gauss);
  const Matrix12 Omega = h / 2 * (J1 + J2) + std::sqrt(3.0) / 12 * h * h * (J2 * J1 - J1 * J2);
  return Omega.exp();
}

/// Speeds of the joints that Coulomb friction acts at, in units of their smoothing speeds.
class RubbingJoints {
 public:
  explicit RubbingJoints(const Scenario& scenario)
      : scenario_(scenario), right_(nocSubject(*scenario.manipulator, scenario.load)) {
    for (const Leg& leg : scenario.manipulator->parameters().legs) rubs_ |= leg.coulomb.any();
  }

  /// True where no joint passes through its smoothing speed between two instants faster than these resolve.
  bool slowBetween(double from, double to) const {
    if (!rubs_) return true;
    const Speeds a = at(from), b = at(to);
    for (std::size_t k = 0; k < a.size(); ++k) {
      const bool away = a[k] * b[k] > 0 && std::min(std::abs(a[k]), std::abs(b[k])) > saturated;
      if (!away && std::abs(a[k] - b[k]) > smooth_change) return false;
    }
    return true;
  }

 private:
  using Speeds = std::array<double, std::size_t{3} * leg_count>;

  Speeds at(double t) const {
    const JointVariables<double> rates = right_.kinematics(scenario_.trajectory->at(t)).joints.q_dot;
    Speeds out{};
    for (int i = 0; i < scenario_.manipulator->legCount(); ++i) {
      const Leg& leg = scenario_.manipulator->leg(i);
      for (std::size_t j = 0; j < 3; ++j) {
        const Coordinate q = rowOf(leg.kind).coordinates[j];
        if (leg.coulomb.on(q) != 0) out[3 * static_cast<std::size_t>(i) + j] = rates.of(q)(i) / leg.coulomb.speedOf(q);
      }
    }
    return out;
  }

  const Scenario& scenario_;
  Subject right_;
  bool rubs_ = false;
};

class Stepping {
 public:
  Stepping(const Scenario& scenario, const AccelerationUnder& accelerations)
      : fine_(scenario, accelerations, 1), blunt_(scenario, accelerations, 2), joints_(scenario) {}

  void over(double from, double to, int depth) {
    const double middle = (from + to) / 2;
    const bool splits = depth < deepest && halvings_ < most_halvings;
    if (splits && !joints_.slowBetween(from, to)) return halves(from, to, depth);
    const Matrix12 whole = propagator(fine_, from, to);
    const Matrix12 halved = propagator(fine_, middle, to) * propagator(fine_, from, middle);
    if (splits && !((whole - halved).norm() <= resolved * halved.norm()) && halved.allFinite())
      return halves(from, to, depth);
    growth_.Phi = (halved * growth_.Phi).eval();
    growth_.coarser = (whole * growth_.coarser).eval();
    growth_.blunter = (propagator(blunt_, from, to) * growth_.blunter).eval();
  }

  const Growth& growth() const { return growth_; }

 private:
  void halves(double from, double to, int depth) {
    ++halvings_;
    const double middle = (from + to) / 2;
    over(from, middle, depth + 1);
    growth_.halved_at.push_back(middle);
    over(middle, to, depth + 1);
  }

  Linearisation fine_, blunt_;
  RubbingJoints joints_;
  int halvings_ = 0;
  Growth growth_{Matrix12::Identity(), Matrix12::Identity(), Matrix12::Identity(), {}};
};

}  // namespace

Growth growthOf(const Scenario& scenario, const AccelerationUnder& accelerations, double end, int intervals) {
  Stepping stepping(scenario, accelerations);
  std::vector<double> ends = knotsWithin(scenario, 0, end);
  for (int k = 1; k <= intervals; ++k) ends.push_back(end * k / intervals);
  std::sort(ends.begin(), ends.end());
  double from = 0;
  for (double to : ends) {
    if (to > from) stepping.over(from, to, 0);
    from = to;
  }
  return stepping.growth();
}

}  // namespace ursula
