#pragma once

// Section 3 of the paper: dynamics.
//
//   M ṫ = −W M t + w^W + w^N                                           (31)
//   t = T q̇,  ṫ = T q̈ + Ṫ q̇,  D T = 0                                  (32), (33)
//   I q̈ + C q̇ = Tᵀw^W,  I = TᵀMT,  C = Tᵀ(MṪ + WMT)                    (34)
//   w^W = w^a + w^g + w^d                                              (35)
//   I q̈ + C q̇ − τ^g − τ^d = τ^a                                        (36)
//   τ^a = −Tᵀ(wⁿ + w^g + w^d),  wⁿ = −Mṫ − WMt                         (37), (38)
// where q̇ are the rates of the driven coordinates, and a load w^e adds to w^g.

#include <Eigen/Cholesky>

#include "nocsolver/noc/body_equations.h"
#include "nocsolver/noc/section_3_complement.h"

namespace ursula {

namespace legs {

/// The driving force that overcomes viscous and smoothed Coulomb friction of one joint.
template <class S>
S frictionForce(const S& viscous, const S& coulomb, const S& speed, const S& rate) {
  using std::tanh;
  const S force = viscous * rate;
  return coulomb == S(0) ? force : S(force + coulomb * tanh(rate / speed));
}

}  // namespace legs

// --- M, W and the wrenches ------------------------------------------------------------------------------------------

template <class S>
S Noc<S>::massOf(int body) const {
  if (body == legs::platform) return machine_.mass;
  if (body % leg_count >= machine_.legs_in_all) return S(0);
  const LegModel<S>& leg = machine_.legs[body % leg_count];
  if (body < leg_count) return leg.mass_1;
  return leg.mass_2;
}

/// Tensors about the mass centres, in B, from the displacements.
template <class S>
BodyTensors<S> Noc<S>::tensors(const NocWorkspace<S>& work) const {
  BodyTensors<S> out;
  out.fill(Matrix3<S>::Zero());
  const auto turned = [](const Matrix3<S>& frame, const Matrix3<S>& I) {
    return Matrix3<S>(frame * I * frame.transpose());
  };
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    const LegState<S>& at = work.legs[i];
    out[i] = turned(at.R_1, leg.I_1);              // (paper, eq. 46a)
    out[leg_count + i] = turned(at.R_2, leg.I_2);  // (paper, eq. 46b)
  }
  out.back() = turned(work.Q, machine_.I_M);  // (paper, eq. 46c)
  return out;
}

/// Mᵢ x of (29), (30b).
template <class S>
Vector6<S> Noc<S>::M(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const {
  return timesM(work.I_B[body], massOf(body), x);  // (paper, eq. 29)
}

/// Wᵢ x of (29), (30b).
template <class S>
Vector6<S> Noc<S>::W(int body, const NocWorkspace<S>& work, const Vector6<S>& x) const {
  return timesW(Vector3<S>(work.bodies[body].twist.template head<3>()), x);  // (paper, eq. 29)
}

template <class S>
BodyVector<S> Noc<S>::inertiaWrench(const NocWorkspace<S>& work) const {
  BodyVector<S> w_n = BodyVector<S>::Zero();
  for (int b = 0; b < body_count; ++b) {
    const BodyMotion<S>& body = work.bodies[b];
    legs::block(w_n, b) = -M(b, work, body.twist_rate) - W(b, work, M(b, work, body.twist));  // (paper, eqs. 28, 38)
  }
  return w_n;
}

template <class S>
BodyVector<S> Noc<S>::gravityWrench() const {
  BodyVector<S> w_g = BodyVector<S>::Zero();
  for (int b = 0; b < body_count; ++b)
    legs::block(w_g, b).template tail<3>() = massOf(b) * machine_.gravity;  // (paper, eq. 45)
  return w_g;
}

/// Adds an effort's wrench at joint j of leg i to the outboard link; the inboard link, or the base, takes the reaction.
template <class S>
void Noc<S>::addJointWrench(const NocWorkspace<S>& work, int i, int j, const S& effort, BodyVector<S>& w) const {
  const LegModel<S>& leg = machine_.legs[i];
  const LegState<S>& at = work.legs[i];
  const LegKindRow& row = rowOf(leg.kind);
  const Vector3<S> along = effort * at.axis[j];
  const auto add = [&](int body, const Vector3<S>& on) {
    auto to = legs::block(w, body);
    if (!slides(row.coordinates[j])) {
      to.template head<3>() += on;
      return;
    }
    to.template head<3>() += (leg.a + at.O_2 - work.bodies[body].c).cross(on);
    to.template tail<3>() += on;
  };
  const bool on_proximal = j < row.joints_of_proximal;
  add(on_proximal ? i : leg_count + i, along);
  if (!on_proximal) add(i, -along);
}

/// w^d of (35): joint friction.
template <class S>
BodyVector<S> Noc<S>::dissipativeWrench(const NocWorkspace<S>& work) const {
  BodyVector<S> w_d = BodyVector<S>::Zero();
  for (int i = 0; i < machine_.legs_in_all; ++i)
    for (int j = 0; j < 3; ++j) {
      const LegModel<S>& leg = machine_.legs[i];
      const S resistance = legs::frictionForce(leg.viscous[j], leg.coulomb[j], leg.speed[j], work.legs[i].rate(j));
      if (resistance != S(0)) addJointWrench(work, i, j, S(-resistance), w_d);
    }
  return w_d;
}

/// Moves the load to the platform's mass centre.
template <class S>
BodyVector<S> Noc<S>::loadWrench(const Motion<S>& motion, const Vector6<S>& load) const {
  BodyVector<S> w_e = BodyVector<S>::Zero();
  const Vector3<S> force = load.template tail<3>();
  legs::block(w_e, legs::platform) << load.template head<3>() - platformArm(motion).cross(force), force;
  return w_e;
}

template <class S>
BodyVector<S> Noc<S>::actuatorWrench(const NocWorkspace<S>& work, const Vector6<S>& efforts) const {
  BodyVector<S> w_a = BodyVector<S>::Zero();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine_.motors[m];
    addJointWrench(work, motor.leg, motor.joint, efforts(m), w_a);  // (paper, eq. 35)
  }
  return w_a;
}

/// Sets t and ṫ of (30a), and the tensors for M of (30b).
template <class S>
void Noc<S>::setBodies(const Motion<S>& motion, NocWorkspace<S>& work) const {
  bodyMotions(motion, work, work.bodies);  // (paper, eq. 30a)
  work.I_B = tensors(work);                // (paper, eq. 30b)
}

// --- rotors (not in the paper) ---
//
// A rotor that turns with its motor's rate q̇ adds the energy ½ j q̇² to that of (30a). By Lagrange's equations
//   I q̈ + C q̇ becomes (I + diag j) q̈ + C q̇, in (36), and τ^a of (37) gains j q̈.

template <class S>
bool Noc<S>::hasRotors() const {
  for (int i = 0; i < machine_.legs_in_all; ++i)
    if (machine_.legs[i].has_rotor) return true;
  return false;
}

template <class S>
Vector6<S> Noc<S>::rotors() const {
  Vector6<S> j;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine_.motors[m];
    j(m) = machine_.legs[motor.leg].rotor[motor.joint];
  }
  return j;
}

/// j q̈ for the accelerations in `work`.
template <class S>
Vector6<S> Noc<S>::rotorEfforts(const NocWorkspace<S>& work) const {
  Vector6<S> out = rotors();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine_.motors[m];
    out(m) *= work.legs[motor.leg].acceleration(motor.joint);
  }
  return out;
}

// --- inverse and direct dynamics ------------------------------------------------------------------------------------

template <class S>
Vector6<S> Noc<S>::inverseDynamics(const Motion<S>& motion, NocWorkspace<S>& work, const Vector6<S>& load) const {
  inverseKinematics(motion, work);
  jacobians(motion, work);
  setBodies(motion, work);
  twistShaping(motion, work);
  const BodyVector<S> w_n = inertiaWrench(work);
  const BodyVector<S> w_g = gravityWrench() + loadWrench(motion, load), w_d = dissipativeWrench(work);
  Vector6<S> tau = -work.T.transpose() * (w_n + w_g + w_d);  // (paper, eq. 37)
  if (hasRotors()) tau += rotorEfforts(work);
  return tau;
}

/// M X, body by body.
template <class S>
TwistShaping<S> Noc<S>::massTimes(const BodyTensors<S>& tensors, const TwistShaping<S>& X) const {
  TwistShaping<S> out;
  for (int b = 0; b < body_count; ++b) {
    legs::block(out, b).template topRows<3>().noalias() = tensors[b] * legs::block(X, b).template topRows<3>();
    legs::block(out, b).template bottomRows<3>() = massOf(b) * legs::block(X, b).template bottomRows<3>();
  }
  return out;
}

template <class S>
Matrix6<S> Noc<S>::I(const NocWorkspace<S>& work) const {
  Matrix6<S> I = work.T.transpose().lazyProduct(massTimes(work.I_B, work.T));  // (paper, eq. 34)
  if (hasRotors()) I.diagonal() += rotors();
  return I;
}

template <class S>
Matrix6<S> Noc<S>::C(const NocWorkspace<S>& work) const {
  TwistShaping<S> sum = massTimes(work.I_B, work.T_rate);
  const TwistShaping<S> MT = massTimes(work.I_B, work.T);
  for (int b = 0; b < body_count; ++b)
    for (int m = 0; m < motor_count; ++m) legs::block(sum, b).col(m) += W(b, work, legs::block(MT, b).col(m));
  return work.T.transpose().lazyProduct(sum);  // (paper, eq. 34)
}

/// τ^g of (36), with the load.
template <class S>
Vector6<S> Noc<S>::tauG(const Motion<S>& motion, const NocWorkspace<S>& work, const Vector6<S>& load) const {
  return work.T.transpose() * (gravityWrench() + loadWrench(motion, load));
}

/// τ^d of (36).
template <class S>
Vector6<S> Noc<S>::tauD(const NocWorkspace<S>& work) const {
  return work.T.transpose() * dissipativeWrench(work);
}

template <class S>
Vector6<S> Noc<S>::directDynamics(const Motion<S>& motion, const Vector6<S>& efforts, NocWorkspace<S>& work,
                                  const Vector6<S>& load) const {
  Motion<S> unaccelerated = motion;
  unaccelerated.omega_dot.setZero();
  unaccelerated.p_ddot.setZero();
  inverseKinematics(unaccelerated, work);
  jacobians(unaccelerated, work);
  setBodies(unaccelerated, work);
  twistShapingRate(unaccelerated, work);
  const Vector6<S> tau_g = tauG(motion, work, load), tau_d = tauD(work);
  const Vector6<S> q_dot = rates(work).driven(machine_.motors);
  const Vector6<S> q_ddot =
      I(work).llt().solve(Vector6<S>(efforts + tau_g + tau_d - C(work) * q_dot));  // (paper, eq. 36)
  return work.T_P * q_ddot + work.T_P_rate * q_dot;                                // (paper, eq. 25)
}

/// M_P = TᵀMT with t = T t_P, by unit twists of the platform.
template <class S>
Matrix6<S> Noc<S>::massMatrixAtP(const Motion<S>& motion, const NocWorkspace<S>& work) const {
  TwistShaping<S> T = TwistShaping<S>::Zero();
  Matrix6<S> J;  // q̇ of the motors for unit twists
  const Matrix6<S> unit = Matrix6<S>::Identity();
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegState<S>& at = work.legs[i];
    const Rates rates = ratesForTwists(i, at, unit);
    for (int j = 0; j < 3; ++j)
      if (const int motor = machine_.legs[i].motor[j]; motor >= 0) J.row(motor) = rates.row(j);
    const UnitTwists of_legs = unitTwists(i, at, false);
    legs::block(T, i) = of_legs.first * rates;
    legs::block(T, leg_count + i) = of_legs.second * rates;
  }
  shapePlatform(platformArm(motion), unit, T);
  Matrix6<S> M_P = T.transpose().lazyProduct(massTimes(tensors(work), T));
  if (hasRotors()) M_P += J.transpose().lazyProduct(Matrix6<S>(rotors().asDiagonal() * J));
  return M_P;
}

}  // namespace ursula
