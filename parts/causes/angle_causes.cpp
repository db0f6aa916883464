#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "parts/causes/tried_causes.h"

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

/// ω = E θ̇.
struct AngleRates {
  Matrix3d E;
  Vector3d rate, bias;  ///< θ̇ and Ė θ̇

  AngleRates(const EulerAxes& at, const Vector3d& omega) {
    E << at.e1, at.e2, at.e3;
    rate = E.lu().solve(omega);
    bias = rate(0) * rate(1) * at.e1.cross(at.e2) + rate(2) * (rate(0) * at.e1 + rate(1) * at.e2).cross(at.e3);
  }
};

/// The angles' rates, and theirs, where ω and ω̇ belong; `of_x` is the angle that stands for x, 0 or 2.
void anglesForOmega(const EulerAxes& at, int of_x, Motion<double>& motion) {
  const AngleRates angles(at, motion.omega);
  const Vector3d &rate = angles.rate, second = angles.E.lu().solve(motion.omega_dot - angles.bias);
  motion.omega = of_x == 0 ? rate : Vector3d(rate.reverse());
  motion.omega_dot = of_x == 0 ? second : Vector3d(second.reverse());
}

/// Turns of Q = Rz Ry Rx made in the order x, y, z, or turns of Q = Rx Ry Rz in the order z, y, x.
Matrix3d inOtherOrder(const Matrix3d& Q, bool is_zyx) {
  const auto turn = [](double angle, int axis) { return Eigen::AngleAxisd(angle, Vector3d::Unit(axis)); };
  if (is_zyx)
    return (turn(std::atan2(Q(2, 1), Q(2, 2)), 0) * turn(std::asin(-Q(2, 0)), 1) *
            turn(std::atan2(Q(1, 0), Q(0, 0)), 2))
        .toRotationMatrix();
  return (turn(std::atan2(-Q(0, 1), Q(0, 0)), 2) * turn(std::asin(Q(0, 2)), 1) * turn(std::atan2(-Q(1, 2), Q(2, 2)), 0))
      .toRotationMatrix();
}

}  // namespace

void addAngleCauses(TriedCauses& out) {
  struct Angles {
    const char* words;
    EulerAxes (*axes)(const Matrix3d&);
    int of_x;
  };
  for (const auto& [words, axes, of_x] :
       {Angles{"roll, pitch and yaw", rollPitchYaw, 2}, {"Cardan's angles x, y, z", cardan, 0}}) {
    const std::string angles = words;
    out.addReading(
        {"rates of " + angles + " taken for the angular velocity", {CauseKind::frame, "angular_velocity", "all"}},
        [axes = axes, of_x = of_x](Motion<double>& motion) { anglesForOmega(axes(motion.Q), of_x, motion); });
    out.addReading(
        {"second rates of " + angles + " without the rate of their matrix",
         {CauseKind::frame, "angular_acceleration", "all"}},
        [axes = axes](Motion<double>& motion) { motion.omega_dot -= AngleRates(axes(motion.Q), motion.omega).bias; });
    out.addReading({angles + " turned in the other order", {CauseKind::frame, "orientation", "all"}},
                   [of_x = of_x](Motion<double>& motion) { motion.Q = inOtherOrder(motion.Q, of_x == 2); });
  }
}

}  // namespace ursula
