#include "validation/limits/amplification.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "validation/limits/linearisation.h"

namespace ursula {
namespace {

using Matrix12 = Amplification::Matrix12;

/// Every fifth instant suffices, because the Jacobian varies slowly with the pose.
constexpr int growth_stride = 5;

struct Rates {
  double growth = 0, decay = 0;
};

/// Returns the larger of the motion's growth and that without friction, because friction slows a fall without stopping
/// it.
Rates fastestRates(const Matrix12& J) {
  const Eigen::VectorXcd moving = eigenvalues(J);
  const double falling = eigenvalues(J.bottomLeftCorner<6, 6>()).cwiseSqrt().real().maxCoeff();
  return {std::max({0.0, moving.real().maxCoeff(), falling}), std::max(0.0, -moving.real().minCoeff())};
}

/// The propagator over one interval from the Jacobians at its ends and its middle: Magnus' expansion to fourth order
/// (Blanes, Casas, Oteo, Ros, Phys. Rep. 470 (2009) 151). Strong friction does not make it unstable.
Matrix12 between(const Matrix12& J0, const Matrix12& J1, const Matrix12& J2, double h) {
  const Matrix12 Omega = h / 6 * (J0 + 4 * J1 + J2) + h * h / 12 * (J2 * J0 - J0 * J2);
  return exponential(Omega);
}

/// The same bits as Eigen's product, which is slow at this size.
Matrix12 product(const Matrix12& a, const Matrix12& b) {
  Matrix12 out;
  for (int j = 0; j < 12; ++j) {
    Amplification::Vector12 column = a.col(0) * b(0, j);
    for (int k = 1; k < 12; ++k) column += a.col(k) * b(k, j);
    out.col(j) = column;
  }
  return out;
}

}  // namespace

double GrowthWindow::bound(double at, double rate, double initial) const {
  const auto after = std::lower_bound(t.begin(), t.end(), at);
  const auto i = static_cast<std::size_t>(std::min(after - t.begin(), static_cast<std::ptrdiff_t>(t.size()) - 1));
  const auto boundAt = [&](std::size_t k) {
    return from_acceleration[k] + rate * from_unit_rate[k] + initial * from_start[k];
  };
  return std::max(boundAt(i), boundAt(i == 0 ? 0 : i - 1));
}

Amplification::Amplification(const Scenario& scenario, int intervals, const Deadline& deadline) {
  Linearisation linearisation(scenario);
  length_ = linearisation.length();
  const double h = scenario.trajectory->duration() / intervals;
  instants_.push_back(0);
  Matrix12 J0 = linearisation.at(0), rated = J0;
  const Matrix12 first = J0;
  const auto addRate = [&](const Matrix12& J) {
    const bool known = !growth_rates_.empty() && J == rated;
    const Rates rates = known ? Rates{growth_rates_.back(), decay_rates_.back()} : fastestRates(J);
    growth_rates_.push_back(rates.growth);
    decay_rates_.push_back(rates.decay);
    rated = J;
  };
  for (int k = 0; k < intervals; ++k) {
    deadline.require();
    const Matrix12 J1 = linearisation.at((k + 0.5) * h), J2 = linearisation.at((k + 1) * h);
    if (uniform_ && k > 0 && (J1 != first || J2 != first)) {
      uniform_ = false;
      propagators_.resize(k, Matrix12(propagators_.front()));
    }
    if (!uniform_ || k == 0) propagators_.push_back(between(J0, J1, J2, h));
    if (J1 != first || J2 != first) uniform_ = false;
    if (k % growth_stride == 0) addRate(J0);
    instants_.push_back((k + 1) * h);
    J0 = J2;
  }
  addRate(J0);
}

std::size_t Amplification::nearest(double t) const {
  const double interval = instants_[1] - instants_[0];
  return std::min(static_cast<std::size_t>(std::lround(t / interval)), instants_.size() - 1);
}

/// Propagates by the trapezoidal rule: the error's effect over one interval is added at its end.
Amplification::Vector12 Amplification::carried(double start, double end,
                                               const std::function<Vector6d(double)>& error) const {
  Vector12 deviation = Vector12::Zero();
  for (std::size_t k = nearest(start); k < nearest(end); ++k) {
    const double h = instants_[k + 1] - instants_[k];
    deviation.tail<6>() += h / 2 * error(instants_[k]);
    deviation = (propagator(k) * deviation).eval();
    deviation.tail<6>() += h / 2 * error(instants_[k + 1]);
  }
  return deviation;
}

double Amplification::carriedBound(double start, double end, const std::function<double(double)>& size) const {
  double bound = 0;
  Matrix12 Phi = Matrix12::Identity();  // from the end of interval k to the end
  for (std::size_t k = nearest(end); k-- > nearest(start);) {
    const double h = instants_[k + 1] - instants_[k];
    const double after = Phi.topRightCorner<6, 6>().norm();
    Phi = (Phi * propagator(k)).eval();
    bound += h / 2 * (after * size(instants_[k + 1]) + Phi.topRightCorner<6, 6>().norm() * size(instants_[k]));
  }
  return bound;
}

double Amplification::growthRate(double t) const {
  const auto last = growth_rates_.size() - 1;
  const double interval = instants_[1] - instants_[0];
  const auto before = static_cast<std::size_t>(std::clamp(t / (growth_stride * interval), 0.0, double(last)));
  return std::max(growth_rates_[before], growth_rates_[std::min(before + 1, last)]);
}

double Amplification::decayRate() const {
  std::vector<double> rates = decay_rates_;
  const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
  std::nth_element(rates.begin(), middle, rates.end());
  return *middle;
}

/// ‖Φ(t_j, t_k)‖ for every k of a window as j advances. Each Φ is propagated forward, so no propagator is inverted. If
/// all propagators are equal, it depends on j − k alone. Frobenius norms bound the spectral ones.
class Amplification::CarriedDeviation {
 public:
  explicit CarriedDeviation(const Amplification& of) : of_(of) {}

  /// Advances from the end of interval j − 1 to that of j.
  void moveOn(std::size_t j) {
    if (Phi_.empty() || !of_.uniform_) {
      Phi_.push_back(Matrix12::Identity());
      norms_.push_back(normsOf(Phi_.back()));
    }
    for (std::size_t k = 0; k < Phi_.size(); ++k) Phi_[k] = product(of_.propagator(j), Phi_[k]);
    before_ = norms_;
    if (of_.uniform_) {
      norms_.push_back(normsOf(Phi_.front()));
    } else {
      for (std::size_t k = 0; k < Phi_.size(); ++k) norms_[k] = normsOf(Phi_[k]);
    }
    ++moved_;
  }

  struct Norms {
    double state = 0, velocity = 0;  ///< effects on the position
  };
  /// For the k-th interval of `moved()`, at the end of the last interval and before it.
  const Norms& now(std::size_t k) const { return of_.uniform_ ? norms_[moved_ - k] : norms_[k]; }
  const Norms& before(std::size_t k) const { return of_.uniform_ ? norms_[moved_ - k - 1] : before_[k]; }
  std::size_t moved() const { return moved_; }
  const Matrix12& fromStart() const { return Phi_.front(); }

 private:
  static Norms normsOf(const Matrix12& Phi) { return {Phi.topRows<6>().norm(), Phi.topRightCorner<6, 6>().norm()}; }

  const Amplification& of_;
  std::size_t moved_ = 0;
  std::vector<Matrix12> Phi_;          ///< Φ(t_j, t_k), k = first …; only the first if all are equal
  std::vector<Norms> norms_, before_;  ///< norms of Φ; indexed by j − k if all are equal
};

std::size_t Amplification::longestWindow() const {
  constexpr std::size_t products =
      10'000'000;  // half as many intervals as a window has are carried at each of its ends
  return std::max<std::size_t>(1, 2 * products / intervals());
}

GrowthWindow Amplification::window(std::size_t first, const std::function<double(double)>& acceleration, double rate,
                                   double useful, const Deadline& deadline) const {
  GrowthWindow out;
  CarriedDeviation carried(*this);
  std::vector<double> errors;  // acceleration errors in interval k, m/s
  const auto add = [&out](double t, double from_acceleration, double from_rate, const Matrix12& from_start) {
    out.t.push_back(t);
    out.from_acceleration.push_back(from_acceleration);
    out.from_unit_rate.push_back(from_rate);
    out.from_start.push_back(from_start.topRows<6>().norm());
    out.growth.push_back(from_start.topRightCorner<6, 6>().norm());
  };
  add(instants_[first], 0, 0, Matrix12::Identity());
  out.last = first;
  out.length = length_;
  for (std::size_t j = first; j < std::min(intervals(), first + longestWindow()); ++j) {
    deadline.require();
    const double h = instants_[j + 1] - instants_[j];
    errors.push_back(h * std::max(acceleration(instants_[j]), acceleration(instants_[j + 1])));
    carried.moveOn(j);
    double from_acceleration = 0, from_rate = 0;
    for (std::size_t k = 0; k < carried.moved(); ++k) {
      from_acceleration += carried.now(k).velocity * errors[k];
      from_rate += h * std::max(carried.before(k).state, carried.now(k).state);
    }
    if (!(from_acceleration + rate * from_rate <= useful) && j > first) break;
    add(instants_[j + 1], from_acceleration, from_rate, carried.fromStart());
    out.last = j + 1;
  }
  return out;
}

}  // namespace ursula
