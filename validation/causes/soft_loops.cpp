#include "validation/causes/fits.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

/// Efforts with open loops, and their change per kilogram of a leg's soft closure. That change is a small difference of
/// forces of size `rounded` per kilogram, and has their rounding.
struct SoftLeg {
  Vector3d open, per_kilogram;
  double rounded = 0;
};

/// A closure answers rounding of the velocity as well, at the rate of its time constant: 20 ms by default.
constexpr double closing_rate = 100;  // 1/s

/// A closure of J and P that leaves out J̇ u takes it for an error of the acceleration, and answers with a force.
SoftLeg softLeg(const OpenLeg& leg, const Motion<double>& motion) {
  Vector6d twist, rate;
  twist << motion.omega, motion.p_dot;
  rate << motion.omega_dot, motion.p_ddot;
  const double condition = leg.J.norm() * leg.J.inverse().norm();  // rates and accelerations are solved by J
  const double velocity = (leg.P * twist).norm(), acceleration = (leg.P * rate + leg.platform_bias).norm();
  return {leg.efforts, -leg.J.transpose() * (leg.bias - leg.platform_bias),
          leg.J.norm() * condition * (acceleration + closing_rate * velocity)};
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Fits the efforts of open loops with one soft closure for each leg.
class SoftFit {
 public:
  SoftFit(const Scenario& scenario, const TorqueResidual& data)
      : motors_(scenario.manipulator->motors()), data_(data), left_(data.exact.size()) {
    for (const Motion<double>& motion : data.motions) {
      legs_.emplace_back();
      for (const OpenLeg& leg : machineTerms(*scenario.manipulator, scenario.load, motion).legs)
        legs_.back().push_back(softLeg(leg, motion));
    }
    for (std::size_t k = 0; k < left_.size(); ++k)
      for (int m = 0; m < motor_count; ++m) left_[k](m) = data.found(k)(m) - leg(k, m).open(motors_[at(m)].joint);
    masses_.resize(at(scenario.manipulator->legCount()));
  }

  /// Returns false if open loops explain all, or if a leg's closure has no effect or would push its gap open.
  bool fit() {
    std::vector<double> over(masses_.size()), under(masses_.size());
    for (std::size_t k = 0; k < left_.size(); ++k)
      for (int m = 0; m < motor_count; ++m) {
        const std::size_t i = at(motors_[at(m)].leg);
        over[i] += perKilogram(k, m) * left_[k](m);
        under[i] += perKilogram(k, m) * perKilogram(k, m);
      }
    grown_ = data_.growth();
    if (data_.beyond(left_) <= grown_) return false;
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      if (!(under[i] > 0) || !(over[i] > 0)) return false;
      masses_[i] = over[i] / under[i];
    }
    double right = 0;
    for (const Vector6d& row : data_.exact) right = std::max(right, row.cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k < left_.size(); ++k)
      for (int m = 0; m < motor_count; ++m) {
        const double mass = masses_[at(motors_[at(m)].leg)];
        left_[k](m) -= mass * perKilogram(k, m);
        grown_ = std::max(grown_, mass * leg(k, m).rounded / right);
      }
    return true;
  }

  Hypothesis found() const {
    const auto [least, most] = std::minmax_element(masses_.begin(), masses_.end());
    Hypothesis out{
        fmt::format("soft constraints of the loops, read at the motors: the loops left open, and at each leg "
                    "{:.4g} to {:.4g} kg times the acceleration of its gap without the rate of the Jacobian",
                    *least, *most),
        norm(left_) / data_.norm(), static_cast<int>(masses_.size())};
    out.beyond = data_.beyond(left_) / grown_;  // rounding grows with what is rounded
    out.named = NamedCause{CauseKind::closure, "soft", "all"};
    return out;
  }

 private:
  const SoftLeg& leg(std::size_t k, int m) const { return legs_[k][at(motors_[at(m)].leg)]; }
  double perKilogram(std::size_t k, int m) const { return leg(k, m).per_kilogram(motors_[at(m)].joint); }

  const Motors& motors_;
  const TorqueResidual& data_;
  std::vector<std::vector<SoftLeg>> legs_;  ///< of each instant
  std::vector<Vector6d> left_;              ///< what remains of the efforts
  std::vector<double> masses_;              ///< of each leg's closure, kg
  double grown_ = 1;                        ///< factor on the limits
};

}  // namespace

std::optional<Hypothesis> softLoops(const Scenario& scenario, const TorqueResidual& data) {
  SoftFit fit(scenario, data);
  if (!fit.fit()) return std::nullopt;
  return fit.found();
}

}  // namespace ursula
