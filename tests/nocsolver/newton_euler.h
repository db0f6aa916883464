#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "nocsolver/noc/noc.h"
#include "tests/nocsolver/mechanism.h"

// The right-hand side of (37) as the paper writes it: one wrench for each body about its mass centre, in B, and the
// product with the whole 78 × 6 twist-shaping matrix, which the solver never forms.

namespace ursula {

template <class S>
struct Inertia {
  S mass;
  Matrix3<S> about_center;  ///< in the body's frame
};

template <class S>
Inertia<S> inertiaOf(const Manipulator& manipulator, int body) {
  const Leg& leg = manipulator.leg(body % leg_count);
  if (body == 2 * leg_count) return {S(manipulator.platform().mass), manipulator.platform().inertia.cast<S>()};
  const Link& link = body < leg_count ? leg.proximal : leg.distal;
  return {S(link.mass), link.inertia.cast<S>()};
}

template <class S>
using GeneralizedWrench = Eigen::Matrix<S, 6 * body_count, 1>;

/// wⁿ of (38) with (46). With `magnitudes` the absolute values of its terms are added, which is the scale of rounding.
template <class S>
Vector6<S> inertiaWrench(const Inertia<S>& inertia, const BodyMotion<S>& body, bool magnitudes = false) {
  const Matrix3<S> I = body.R * inertia.about_center * body.R.transpose();
  const Vector3<S> omega = body.twist.template head<3>();
  const Vector3<S> gyroscopic = omega.cross(Vector3<S>(I * omega));
  const Vector3<S> angular = I * body.twist_rate.template head<3>();
  const Vector3<S> linear = inertia.mass * body.twist_rate.template tail<3>();
  Vector6<S> w;
  if (magnitudes)
    w << gyroscopic.cwiseAbs() + angular.cwiseAbs(), linear.cwiseAbs();
  else
    w << -gyroscopic - angular, -linear;
  return w;
}

/// w^g of (45).
template <class S>
Vector6<S> gravityWrench(const Inertia<S>& inertia, const Vector3<S>& gravity) {
  Vector6<S> w;
  w << Vector3<S>::Zero(), inertia.mass * gravity;
  return w;
}

template <class S>
S frictionTorque(double viscous, double coulomb, double speed, const S& rate) {
  using std::tanh;
  return -(S(viscous) * rate + S(coulomb) * tanh(S(rate / S(speed))));
}

/// Adds w^d of (35): the moments of friction in the joints on the bodies that they connect. φ turns about −u, ψ and θ
/// about x.
template <class S>
void addFriction(const Manipulator& manipulator, const BodyMotions<S>& bodies, const JointVariables<S>& rates,
                 GeneralizedWrench<S>& w) {
  for (int i = 0; i < leg_count; ++i) {
    const Leg& leg = manipulator.leg(i);
    const auto index = static_cast<std::size_t>(i);
    const LegJoints<S> joints = legJoints<S>(leg, bodies[index], bodies[leg_count + index]);
    const double speed = leg.coulomb.smoothing_speed;
    const S phi = frictionTorque(leg.friction.phi, leg.coulomb.phi, speed, rates.phi(i));
    const S psi = frictionTorque(leg.friction.psi, leg.coulomb.psi, speed, rates.psi(i));
    const S theta = frictionTorque(leg.friction.theta, leg.coulomb.theta, speed, rates.theta(i));
    w.template segment<3>(6 * i) += -phi * joints.u + (psi - theta) * joints.x;
    w.template segment<3>(6 * (leg_count + i)) += theta * joints.x;
  }
}

/// wⁿ + w^g + w^d of (37).
template <class S>
GeneralizedWrench<S> generalizedWrench(const Manipulator& manipulator, const BodyMotions<S>& bodies,
                                       const JointVariables<S>& rates) {
  GeneralizedWrench<S> w;
  for (int b = 0; b < body_count; ++b) {
    const Inertia<S> inertia = inertiaOf<S>(manipulator, b);
    w.template segment<6>(6 * b) = inertiaWrench(inertia, bodies[static_cast<std::size_t>(b)]) +
                                   gravityWrench<S>(inertia, manipulator.gravity().cast<S>());
  }
  addFriction(manipulator, bodies, rates, w);
  return w;
}

/// ‖|T|ᵀ|w|‖: the size of the cancelling terms in (37).
template <class S>
S wrenchScale(const Manipulator& manipulator, const BodyMotions<S>& bodies, const JointVariables<S>& rates,
              const TwistShaping<S>& T) {
  GeneralizedWrench<S> w = GeneralizedWrench<S>::Zero();
  addFriction(manipulator, bodies, rates, w);
  w = w.cwiseAbs().eval();
  for (int b = 0; b < body_count; ++b) {
    const Inertia<S> inertia = inertiaOf<S>(manipulator, b);
    w.template segment<6>(6 * b) += inertiaWrench(inertia, bodies[static_cast<std::size_t>(b)], true) +
                                    gravityWrench<S>(inertia, manipulator.gravity().cast<S>()).cwiseAbs();
  }
  return (T.cwiseAbs().transpose() * w).norm();
}

/// I = TᵀMT of (34).
template <class S>
Matrix6<S> generalizedInertia(const Manipulator& manipulator, const BodyMotions<S>& bodies, const TwistShaping<S>& T) {
  Matrix6<S> out = Matrix6<S>::Zero();
  for (int b = 0; b < body_count; ++b) {
    const Inertia<S> inertia = inertiaOf<S>(manipulator, b);
    const Matrix3<S>& R = bodies[static_cast<std::size_t>(b)].R;
    const Matrix3<S> I = R * inertia.about_center * R.transpose();
    const auto angular = T.template middleRows<3>(6 * b), linear = T.template middleRows<3>(6 * b + 3);
    out += angular.transpose() * I * angular + inertia.mass * linear.transpose() * linear;
  }
  return out;
}

}  // namespace ursula
