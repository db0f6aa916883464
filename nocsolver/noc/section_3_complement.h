#pragma once

// Section 3 of the paper: the natural orthogonal complement T and its rate (32), (47), (48).

#include "nocsolver/noc/section_3_bodies.h"

namespace ursula {

/// Twists of both links for a unit rate of each of the leg's joints; `with_rate` adds the rates of these twists.
template <class S>
typename Noc<S>::UnitTwists Noc<S>::unitTwists(int i, const LegState<S>& at, bool with_rate) const {
  UnitTwists out;
  for (int j = 0; j < 3; ++j) {
    const Vector3<S> one = Vector3<S>::Unit(j), none = Vector3<S>::Zero();
    const LinkMotions<S> unit = links(i, at, one, none, with_rate);
    out.first.col(j) << unit.proximal.omega, unit.proximal.c_dot;
    out.second.col(j) << unit.distal.omega, unit.distal.c_dot;
    if (!with_rate) continue;
    out.first_rate.col(j) << unit.proximal.omega_dot, unit.proximal.c_ddot;
    out.second_rate.col(j) << unit.distal.omega_dot, unit.distal.c_ddot;
  }
  return out;
}

/// Rates of leg i's joints for the platform twists in the columns of `T_P`; linear in the velocity of Bᵢ.
template <class S>
typename Noc<S>::Rates Noc<S>::ratesForTwists(int i, const LegState<S>& at, const Matrix6<S>& T_P) const {
  Matrix3<S> by_v_B;
  for (int k = 0; k < 3; ++k) by_v_B.col(k) = jointRates(i, at, Vector3<S>(Vector3<S>::Unit(k)));
  Rates v_B;
  for (int m = 0; m < motor_count; ++m) v_B.col(m) = legs::velocityOf<S>(T_P.col(m), at.Qb);
  return by_v_B * v_B;
}

/// Rates of leg i's joints for q̇ = e_m in column m: δ_m of (48) for the leg.
template <class S>
typename Noc<S>::Rates Noc<S>::columnRates(int i, const LegState<S>& at, const Matrix6<S>& T_P) const {
  const LegModel<S>& leg = machine_.legs[i];
  Rates out = ratesForTwists(i, at, T_P);
  for (int j = 0; j < 3; ++j) {
    const int motor = leg.motor[j];
    if (motor >= 0) out.row(j) = Vector6<S>::Unit(motor).transpose();  // (paper, eq. 48)
  }
  return out;
}

/// The rates of columnRates; a column's own unit rate is constant, so its rate is zero.
template <class S>
typename Noc<S>::Rates Noc<S>::columnAccelerations(const Motion<S>& motion, int i, const NocWorkspace<S>& work,
                                                   const Rates& rates) const {
  const LegModel<S>& leg = machine_.legs[i];
  const LegState<S>& at = work.legs[i];
  Rates out;
  for (int m = 0; m < motor_count; ++m)
    out.col(m) = jointAccelerations(i, at, Vector3<S>(rates.col(m)), legs::velocityOf<S>(work.T_P.col(m), at.Qb),
                                    columnAcceleration(motion, work, m, at.Qb));
  for (int j = 0; j < 3; ++j)
    if (leg.motor[j] >= 0) out.row(j).setZero();
  return out;
}

/// The rate of the velocity that column m gives to the platform's point at `arm` from P.
template <class S>
Vector3<S> Noc<S>::columnAcceleration(const Motion<S>& motion, const NocWorkspace<S>& work, int m,
                                      const Vector3<S>& arm) const {
  const Vector3<S> omega = work.T_P.col(m).template head<3>();
  return legs::velocityOf<S>(work.T_P_rate.col(m), arm) + omega.cross(motion.omega.cross(arm));
}

/// Moves the platform's twists from P to its mass centre at `arm` from P.
template <class S>
void Noc<S>::shapePlatform(const Vector3<S>& arm, const Matrix6<S>& T_P, TwistShaping<S>& T) const {
  auto T_C = legs::block(T, legs::platform);
  T_C = T_P;
  for (int m = 0; m < motor_count; ++m)
    T_C.col(m).template tail<3>() = legs::velocityOf<S>(T_P.col(m), arm);  // (paper, eq. 47)
}

template <class S>
void Noc<S>::twistShaping(const Motion<S>& motion, NocWorkspace<S>& work) const {
  shape(motion, work, false);
}

template <class S>
void Noc<S>::twistShapingRate(const Motion<S>& motion, NocWorkspace<S>& work) const {
  shape(motion, work, true);
}

/// T column by column as in (48). Its rate comes from the accelerations of (17), (43) in the actual motion, for one
/// column's rates and their rates.
template <class S>
void Noc<S>::shape(const Motion<S>& motion, NocWorkspace<S>& work, bool with_rate) const {
  work.T_P = platformShaping(work);
  work.T.setZero();
  shapePlatform(columnArm(motion), work.T_P, work.T);  // B_C⁻¹A
  if (with_rate) {
    work.T_P_rate = platformShapingRate(motion, work);
    work.T_rate.setZero();
  }
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegState<S>& at = work.legs[i];
    const Rates rates = columnRates(i, at, work.T_P);
    const UnitTwists unit = unitTwists(i, at, with_rate);
    legs::block(work.T, i) = unit.first * rates;
    legs::block(work.T, leg_count + i) = unit.second * rates;
    if (!with_rate) continue;
    const Rates accelerations = columnAccelerations(motion, i, work, rates);
    legs::block(work.T_rate, i) = unit.first_rate * rates + unit.first * accelerations;
    legs::block(work.T_rate, leg_count + i) = unit.second_rate * rates + unit.second * accelerations;
  }
  if (!with_rate) return;
  auto T_C_rate = legs::block(work.T_rate, legs::platform);
  T_C_rate = work.T_P_rate;
  for (int m = 0; m < motor_count; ++m)
    T_C_rate.col(m).template tail<3>() = columnAcceleration(motion, work, m, platformArm(motion));
}

}  // namespace ursula
