#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "parts/causes/fits.h"
#include "validation/subject/body_terms.h"

namespace ursula {
namespace {

/// The efforts with open loops, and each effort's change per kilogram of its leg's soft closure. The change is a small
/// difference of forces of size `rounded` per kilogram, and has their rounding.
struct SoftLoops {
  Vector6d open, per_kilogram, rounded;
};

/// A closure answers rounding of the velocity as well, at the rate of its time constant: 20 ms by default.
constexpr double closing_rate = 100;  // 1/s

const Motor& motorAt(const Motors& motors, int m) { return motors[m]; }

/// A closure of J and P that leaves out J̇ u takes it for an error of the acceleration, and answers with a force.
SoftLoops softLoopsAt(const MachineTerms& machine, const Motion<double>& motion) {
  Vector6d twist, rate;
  twist << motion.omega, motion.p_dot;
  rate << motion.omega_dot, motion.p_ddot;
  SoftLoops out;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motorAt(machine.motors, m);
    const OpenLeg& leg = machine.legs[motor.leg];
    const double condition = leg.J.norm() * leg.J.inverse().norm();  // rates and accelerations are solved by J
    const double velocity = (leg.P * twist).norm(), acceleration = (leg.P * rate + leg.platform_bias).norm();
    const Vector3d per_kilogram = -leg.J.transpose() * (leg.bias - leg.platform_bias);
    out.open(m) = leg.efforts(motor.joint);
    out.per_kilogram(m) = per_kilogram(motor.joint);
    out.rounded(m) = leg.J.norm() * condition * (acceleration + closing_rate * velocity);
  }
  return out;
}

/// Fits the mass of each leg's closure to what open loops leave. Empty if a closure has no effect or would push its gap
/// open.
std::vector<double> massesOf(const Manipulator& machine, const std::vector<SoftLoops>& rows,
                             const std::vector<Vector6d>& left) {
  const std::size_t legs = machine.legCount();
  std::vector<double> over(legs), under(legs);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int m = 0; m < motor_count; ++m) {
      const std::size_t leg = motorAt(machine.motors(), m).leg;
      const double change = rows[k].per_kilogram(m);
      over[leg] += change * left[k](m);
      under[leg] += change * change;
    }
  for (std::size_t i = 0; i < legs; ++i) {
    if (!(under[i] > 0) || !(over[i] > 0)) return {};
    over[i] /= under[i];
  }
  return over;
}

}  // namespace

std::optional<Hypothesis> softLoops(const Scenario& scenario, const TorqueResidual& data) {
  const Manipulator& machine = *scenario.manipulator;
  std::vector<SoftLoops> rows;
  std::vector<Vector6d> left;
  double right = 0, grown = data.growth();
  for (std::size_t k = 0; k < data.exact.size(); ++k) {
    rows.push_back(softLoopsAt(machineTerms(machine, scenario.load, data.motions[k]), data.motions[k]));
    left.emplace_back(data.found(k) - rows[k].open);
    right = std::max(right, data.exact[k].cwiseAbs().maxCoeff());
  }
  if (data.beyond(left) <= grown) return std::nullopt;  // open loops explain all
  const std::vector<double> masses = massesOf(machine, rows, left);
  if (masses.empty()) return std::nullopt;
  for (std::size_t k = 0; k < left.size(); ++k)
    for (int m = 0; m < motor_count; ++m) {
      const double mass = masses[motorAt(machine.motors(), m).leg];
      left[k](m) -= mass * rows[k].per_kilogram(m);
      grown = std::max(grown, mass * rows[k].rounded(m) / right);
    }
  const auto [least, most] = std::minmax_element(masses.begin(), masses.end());
  Hypothesis out{fmt::format("soft constraints of the loops, read at the motors: the loops left open, and at each leg "
                             "{:.4g} to {:.4g} kg times the acceleration of its gap without the rate of the Jacobian",
                             *least, *most),
                 norm(left) / data.norm(), static_cast<int>(masses.size())};
  out.beyond = data.beyond(left) / grown;  // rounding grows with what is rounded
  out.named = NamedCause{CauseKind::closure, "soft", "all"};
  return out;
}

}  // namespace ursula
