#include "validation/limits/amplification.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "validation/limits/linearisation.h"

namespace ursula {
namespace {

using Matrix12 = Amplification::Matrix12;

/// Every fifth instant will do: the Jacobian varies with the pose, and slowly.
constexpr int growth_stride = 5;

/// Of the motion as it is, and at rest without friction, which slows a fall but holds nothing.
double fastestGrowth(const Matrix12& J) {
  const double moving = Eigen::EigenSolver<Matrix12>(J, false).eigenvalues().real().maxCoeff();
  const Matrix6d stiffness = J.bottomLeftCorner<6, 6>();
  const double falling = Eigen::EigenSolver<Matrix6d>(stiffness, false).eigenvalues().cwiseSqrt().real().maxCoeff();
  return std::max({0.0, moving, falling});
}

/// Over one interval, from the Jacobians at its ends and its middle: Magnus' expansion to fourth order (Blanes, Casas,
/// Oteo, Ros, Phys. Rep. 470 (2009) 151), which strong friction does not make unstable.
Matrix12 propagator(const Matrix12& J0, const Matrix12& J1, const Matrix12& J2, double h) {
  const Matrix12 Omega = h / 6 * (J0 + 4 * J1 + J2) + h * h / 12 * (J2 * J0 - J0 * J2);
  return Omega.exp();
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

Amplification::Amplification(const Scenario& scenario, int intervals) {
  Linearisation linearisation(scenario);
  length_ = linearisation.length();
  const double h = scenario.trajectory->duration() / intervals;
  instants_.push_back(0);
  Matrix12 J0 = linearisation.at(0);
  for (int k = 0; k < intervals; ++k) {
    const Matrix12 J1 = linearisation.at((k + 0.5) * h), J2 = linearisation.at((k + 1) * h);
    propagators_.push_back(propagator(J0, J1, J2, h));
    if (k % growth_stride == 0) growth_rates_.push_back(fastestGrowth(J0));
    instants_.push_back((k + 1) * h);
    J0 = J2;
  }
  growth_rates_.push_back(fastestGrowth(J0));
}

std::size_t Amplification::nearest(double t) const {
  const double interval = instants_[1] - instants_[0];
  return std::min(static_cast<std::size_t>(std::lround(t / interval)), instants_.size() - 1);
}

/// Carried forward by the trapezoidal rule: what the error does in one interval is added at its end.
Amplification::Vector12 Amplification::carried(double start, double end,
                                               const std::function<Vector6d(double)>& error) const {
  Vector12 deviation = Vector12::Zero();
  for (std::size_t k = nearest(start); k < nearest(end); ++k) {
    const double h = instants_[k + 1] - instants_[k];
    deviation.tail<6>() += h / 2 * error(instants_[k]);
    deviation = (propagators_[k] * deviation).eval();
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
    Phi = (Phi * propagators_[k]).eval();
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

/// Φ(t_j, t_k) is carried forward for every k of the window, so no propagator is ever inverted. Frobenius norms bound
/// the spectral ones.
GrowthWindow Amplification::window(std::size_t first, const std::function<double(double)>& acceleration, double rate,
                                   double useful) const {
  GrowthWindow out;
  std::vector<Matrix12> Phi;   // Φ(t_j, t_k), k = first …
  std::vector<double> errors;  // of acceleration in interval k, m/s
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
  for (std::size_t j = first; j < propagators_.size(); ++j) {
    const double h = instants_[j + 1] - instants_[j];
    Phi.push_back(Matrix12::Identity());
    errors.push_back(h * std::max(acceleration(instants_[j]), acceleration(instants_[j + 1])));
    double from_acceleration = 0, from_rate = 0;
    for (std::size_t k = 0; k < Phi.size(); ++k) {
      const double before = Phi[k].topRows<6>().norm();
      Phi[k] = (propagators_[j] * Phi[k]).eval();
      from_acceleration += Phi[k].topRightCorner<6, 6>().norm() * errors[k];
      from_rate += h * std::max(before, Phi[k].topRows<6>().norm());
    }
    if (!(from_acceleration + rate * from_rate <= useful) && j > first) break;
    add(instants_[j + 1], from_acceleration, from_rate, Phi.front());
    out.last = j + 1;
  }
  return out;
}

}  // namespace ursula
