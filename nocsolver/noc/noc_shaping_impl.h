#pragma once

// The bodies and their twists (39)–(43), T and its rate (32), (47), (48); included by noc_impl.h.

#include <Eigen/Geometry>

#include "nocsolver/noc/noc_kinematics_impl.h"

namespace ursula {

namespace legs {

constexpr int platform = 2 * leg_count;

template <class Of>
auto block(Of& of, int body) {
  return of.template middleRows<6>(6 * body);
}

/// The velocity of a point at `arm` from P for a twist [ω; v] at P.
template <class S>
Vector3<S> velocityOf(const Vector6<S>& twist, const Vector3<S>& arm) {
  return twist.template tail<3>() + Vector3<S>(twist.template head<3>()).cross(arm);
}

}  // namespace legs

// --- bodies and their twists ----------------------------------------------------------------------------------------

template <class S>
LinkMotions<S> Noc<S>::onLines(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                               bool with_rates) const {
  const LegModel<S>& leg = machine_.legs[legs::at(i)];
  return legs::withLeg(leg.kind, [&](auto kind) {
    return with_rates ? kind.links(leg, at, rate, acceleration)
                      : kind.template links<false>(leg, at, rate, acceleration);
  });
}

template <class S>
LinkMotions<S> Noc<S>::links(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& acceleration,
                             bool with_rates) const {
  LinkMotions<S> out = onLines(i, at, rate, acceleration, with_rates);
  if (machine_.legs[legs::at(i)].off_line) addOffLine(i, at, out);
  return out;
}

/// Moves twists from the points on the links' lines to the mass centres. It is bilinear like the links of each kind:
/// `links` may hold ω of a column of T. The frame moves as `at` does.
template <class S>
void Noc<S>::addOffLine(int i, const LegState<S>& at, LinkMotions<S>& links) const {
  const LegModel<S>& leg = machine_.legs[legs::at(i)];
  const LinkMotions<S> now = onLines(i, at, at.rate, Vector3<S>(Vector3<S>::Zero()), false);
  const auto add = [](const Vector3<S>& off, const Vector3<S>& omega_now, LinkMotion<S>& link) {
    link.c_dot += link.omega.cross(off);
    link.c_ddot += link.omega_dot.cross(off);
    link.c_ddot += link.omega.cross(omega_now.cross(off));
  };
  add(at.R_1 * leg.off_1, now.proximal.omega, links.proximal);
  add(at.R_2 * leg.off_2, now.distal.omega, links.distal);
}

template <class S>
Vector3<S> Noc<S>::platformArm(const Motion<S>& motion) const {
  return motion.Q * machine_.rho;
}

/// Q(bᵢ − ρ) of (47) is taken from P by this arm.
template <class S>
Vector3<S> Noc<S>::columnArm(const Motion<S>& motion) const {
  return platformArm(motion);
}

template <class S>
void Noc<S>::bodyMotions(const Motion<S>& motion, const NocWorkspace<S>& work, BodyMotions<S>& bodies) const {
  bodies = BodyMotions<S>();
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[legs::at(i)];
    const LegState<S>& at = work.legs[legs::at(i)];
    const LinkMotions<S> now = links(i, at, at.rate, at.acceleration, true);
    const auto set = [&](BodyMotion<S>& body, const Vector3<S>& c, const Matrix3<S>& frame, const LinkMotion<S>& link) {
      body.c = leg.a + c;  // (paper, eqs. 39a, 39b)
      body.R = frame;
      body.twist << link.omega, link.c_dot;
      body.twist_rate << link.omega_dot, link.c_ddot;
    };
    set(bodies[legs::at(i)], at.O_1 + at.arm_1, at.R_1, now.proximal);
    set(bodies[legs::at(leg_count + i)], at.O_2 + at.arm_2, at.R_2, now.distal);
    if (!leg.off_line) continue;
    bodies[legs::at(i)].c += at.R_1 * leg.off_1;
    bodies[legs::at(leg_count + i)].c += at.R_2 * leg.off_2;
  }
  const Vector3<S> arm = platformArm(motion), across = motion.omega.cross(arm);
  BodyMotion<S>& body = bodies[legs::platform];
  body.c = motion.p + arm;  // (paper, eq. 39c)
  body.R = motion.Q;
  body.twist << motion.omega, motion.p_dot + across;  // (paper, eq. 41c)
  Vector3<S> c_ddot = motion.p_ddot + motion.omega_dot.cross(arm);
  c_ddot += motion.omega.cross(across);
  body.twist_rate << motion.omega_dot, c_ddot;  // (paper, eq. 43c)
}

// --- T and its rate -------------------------------------------------------------------------------------------------

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
  const LegModel<S>& leg = machine_.legs[legs::at(i)];
  Rates out = ratesForTwists(i, at, T_P);
  for (int j = 0; j < 3; ++j) {
    const int motor = leg.motor[legs::at(j)];
    if (motor >= 0) out.row(j) = Vector6<S>::Unit(motor).transpose();  // (paper, eq. 48)
  }
  return out;
}

/// The rates of columnRates; a column's own unit rate is constant, so its rate is zero.
template <class S>
typename Noc<S>::Rates Noc<S>::columnAccelerations(const Motion<S>& motion, int i, const NocWorkspace<S>& work,
                                                   const Rates& rates) const {
  const LegModel<S>& leg = machine_.legs[legs::at(i)];
  const LegState<S>& at = work.legs[legs::at(i)];
  Rates out;
  for (int m = 0; m < motor_count; ++m)
    out.col(m) = jointAccelerations(i, at, Vector3<S>(rates.col(m)), legs::velocityOf<S>(work.T_P.col(m), at.Qb),
                                    columnAcceleration(motion, work, m, at.Qb));
  for (int j = 0; j < 3; ++j)
    if (leg.motor[legs::at(j)] >= 0) out.row(j).setZero();
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
    const LegState<S>& at = work.legs[legs::at(i)];
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
