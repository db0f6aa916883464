#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "validation/external/tried_causes.h"

namespace ursula {
namespace {

/// Q = R₁ R₂ R₃, turns about axes of the frame that turns along: the directions of their rates in B, e₁, e₂, e₃.
struct EulerAxes {
  Vector3d e1, e2, e3;
};
EulerAxes rollPitchYaw(const Matrix3d& Q) {
  const double pitch = std::asin(-Q(2, 0)), yaw = std::atan2(Q(1, 0), Q(0, 0));
  return {Vector3d::UnitZ(),
          {-std::sin(yaw), std::cos(yaw), 0},
          {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), -std::sin(pitch)}};
}
EulerAxes cardan(const Matrix3d& Q) {
  const double first = std::atan2(-Q(1, 2), Q(2, 2)), second = std::asin(Q(0, 2));
  return {Vector3d::UnitX(),
          {0, std::cos(first), std::sin(first)},
          {std::sin(second), -std::sin(first) * std::cos(second), std::cos(first) * std::cos(second)}};
}

/// The angles' rates, and theirs, where ω and ω̇ belong; `of_x` is the angle that stands for x, 0 or 2.
void anglesForOmega(const EulerAxes& at, int of_x, Motion<double>& motion) {
  Matrix3d E;
  E << at.e1, at.e2, at.e3;
  const Vector3d rate = E.lu().solve(motion.omega);
  const Vector3d bias =
      rate(0) * rate(1) * at.e1.cross(at.e2) + rate(2) * (rate(0) * at.e1 + rate(1) * at.e2).cross(at.e3);
  const Vector3d second = E.lu().solve(motion.omega_dot - bias);
  motion.omega = of_x == 0 ? rate : Vector3d(rate.reverse());
  motion.omega_dot = of_x == 0 ? second : Vector3d(second.reverse());
}

void addAngles(const Scenario& scenario, std::vector<Cause>& out) {
  const NamedCause named{CauseKind::frame, "angular_velocity", "all"};
  out.push_back(readOtherwise(scenario, {"rates of roll, pitch and yaw taken for the angular velocity", named},
                              [](Motion<double>& motion) { anglesForOmega(rollPitchYaw(motion.Q), 2, motion); }));
  out.push_back(readOtherwise(scenario, {"rates of Cardan's angles x, y, z taken for the angular velocity", named},
                              [](Motion<double>& motion) { anglesForOmega(cardan(motion.Q), 0, motion); }));
}

void addUnits(const Scenario& scenario, std::vector<Cause>& out) {
  constexpr double millimetres = 1000;
  using Of = std::vector<Vector3d Motion<double>::*>;
  const auto add = [&](const char* text, const char* term, double factor, const Of& of,
                       CauseKind kind = CauseKind::units) {
    NamedCause named{kind, term, "all"};
    named.expected = 1;
    named.found = factor;
    out.push_back(readOtherwise(scenario, {text, named}, [of, factor](Motion<double>& motion) {
      for (const auto each : of) motion.*each *= factor;
    }));
  };
  const Of omega = {&Motion<double>::omega}, rate = {&Motion<double>::omega_dot},
           both = {&Motion<double>::omega, &Motion<double>::omega_dot};
  add("omega in degrees per second", "angular_velocity", degrees_per_radian, omega);
  add("omega in degrees per second, taken for radians", "angular_velocity", 1 / degrees_per_radian, omega);
  add("the rate of omega in degrees", "angular_acceleration", degrees_per_radian, rate);
  add("the rate of omega in degrees, taken for radians", "angular_acceleration", 1 / degrees_per_radian, rate);
  add("the velocity of P in millimetres", "velocity", millimetres, {&Motion<double>::p_dot});
  add("the acceleration of P in millimetres", "acceleration", millimetres, {&Motion<double>::p_ddot});
  add("omega and its rate in degrees", "angular_velocity", degrees_per_radian, both);
  add("omega and its rate in degrees, taken for radians", "angular_velocity", 1 / degrees_per_radian, both);
  add("half of the angular velocity, as of a quaternion's rate without its factor of 2", "angular_velocity", 0.5, omega,
      CauseKind::scale);
}

}  // namespace

std::vector<Cause> rateCauses(const Scenario& scenario) {
  std::vector<Cause> out;
  addAngles(scenario, out);
  addUnits(scenario, out);
  return out;
}

}  // namespace ursula
