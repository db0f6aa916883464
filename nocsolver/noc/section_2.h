#pragma once

// Section 2 of the paper, kinematics (1)–(26), for legs of all kinds.

#include <cmath>

#include "nocsolver/legs/leg_of.h"
#include "nocsolver/noc/noc.h"

namespace ursula {
template <class S>
void Noc<S>::place(const Motion<S>& motion, int i, LegState<S>& out) const {
  const LegModel<S>& leg = machine_.legs[i];
  out.Qb.noalias() = motion.Q * leg.b;
  out.AB = (motion.p - leg.a) + out.Qb;  // (paper, eq. 3), in an order that keeps digits far from the base's origin
  displacement(i, motion.t, out);
  rows(i, out);
}

template <class S>
void Noc<S>::displacement(int i, const S& t, LegState<S>& out) const {
  const LegModel<S>& leg = machine_.legs[i];
  legs::withLeg(leg.kind, [&](auto kind) {
    kind.displacement(leg, i, t, out);
    setFrames(leg, out);
    kind.ends(leg, out);
  });
}

/// Frames of the links, and the way along them to the mass centres.
template <class S>
void Noc<S>::setFrames(const LegModel<S>& leg, LegState<S>& out) {
  out.R_1 << out.x_1, out.e.cross(out.x_1), out.e;          // (paper, eq. 40)
  out.R_2 << out.x_2, out.along.cross(out.x_2), out.along;  // (paper, eq. 40)
  out.arm_1 = leg.rho * out.e;
  out.arm_2 = leg.sigma * out.along;
}

template <class S>
void Noc<S>::rows(int i, LegState<S>& out) const {
  const LegModel<S>& leg = machine_.legs[i];
  legs::withLeg(leg.kind, [&](auto kind) { kind.rows(leg, out); });
}

template <class S>
void Noc<S>::rowRates(int i, LegState<S>& out) const {
  const LegModel<S>& leg = machine_.legs[i];
  legs::withLeg(leg.kind, [&](auto kind) { kind.rowRates(leg, out); });
}

template <class S>
Vector3<S> Noc<S>::jointRates(int i, const LegState<S>& at, const Vector3<S>& v_B) const {
  const LegModel<S>& leg = machine_.legs[i];
  return legs::withLeg(leg.kind, [&](auto kind) { return Vector3<S>(kind.rates(leg, at, v_B)); });
}

template <class S>
Vector3<S> Noc<S>::jointAccelerations(int i, const LegState<S>& at, const Vector3<S>& rate, const Vector3<S>& v_B,
                                      const Vector3<S>& a_B) const {
  const LegModel<S>& leg = machine_.legs[i];
  return legs::withLeg(leg.kind, [&](auto kind) { return Vector3<S>(kind.accelerations(leg, at, rate, v_B, a_B)); });
}

template <class S>
void Noc<S>::displacements(const Motion<S>& motion, NocWorkspace<S>& work) const {
  work.Q = motion.Q;
  for (int i = 0; i < machine_.legs_in_all; ++i) place(motion, i, work.legs[i]);
}

template <class S>
void Noc<S>::inverseKinematics(const Motion<S>& motion, NocWorkspace<S>& work) const {
  work.Q = motion.Q;
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    LegState<S>& at = work.legs[i];
    place(motion, i, at);
    const Vector3<S> across = motion.omega.cross(at.Qb);
    at.v_B = motion.p_dot + across;
    at.a_B = motion.p_ddot + motion.omega_dot.cross(at.Qb) + motion.omega.cross(across);
    legs::withLeg(leg.kind, [&](auto kind) { kind.requireRates(i, motion.t, at); });
    at.rate = jointRates(i, at, at.v_B);
    rowRates(i, at);
    at.acceleration = jointAccelerations(i, at, at.rate, at.v_B, at.a_B);
  }
}

namespace legs {
/// Calls f with each coordinate of the machine, its leg and its index there.
template <class S, class F>
JointVariables<S> collect(const MachineParameters<S>& machine, const F& f) {
  JointVariables<S> q;
  for (int i = 0; i < machine.legs_in_all; ++i)
    for (int j = 0; j < 3; ++j) {
      const Coordinate coordinate = rowOf(machine.legs[i].kind).coordinates[j];
      q.of(coordinate)(i) = f(i, j, coordinate);
    }
  return q;
}
}  // namespace legs

template <class S>
JointVariables<S> Noc<S>::angles(const NocWorkspace<S>& work) const {
  using std::atan2;
  JointVariables<S> q = legs::collect(machine_, [&](int i, int j, Coordinate coordinate) {
    const LegState<S>& at = work.legs[i];
    if (slides(coordinate)) return at.cosine[j];
    return S(atan2(at.sine[j], at.cosine[j]));  // (paper, eqs. 4a, 14a)
  });
  for (int i = 0; i < machine_.legs_in_all; ++i) {
    const LegModel<S>& leg = machine_.legs[i];
    const LegState<S>& at = work.legs[i];
    if (leg.kind != LegKind::URS) continue;
    q.psi(i) = atan2(S(leg.s * at.sine[2]), S(leg.l - leg.s * at.cosine[2])) +
               atan2(S(at.AB.cross(leg.u).norm()), S(at.AB.dot(leg.u)));  // (paper, eq. 14b)
  }
  return q;
}

template <class S>
JointVariables<S> Noc<S>::rates(const NocWorkspace<S>& work) const {
  return legs::collect(machine_, [&](int i, int j, Coordinate) { return work.legs[i].rate(j); });
}

template <class S>
JointVariables<S> Noc<S>::accelerations(const NocWorkspace<S>& work) const {
  return legs::collect(machine_, [&](int i, int j, Coordinate) { return work.legs[i].acceleration(j); });
}

template <class S>
void Noc<S>::jacobians(const Motion<S>& motion, NocWorkspace<S>& work) const {
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine_.motors[m];
    const LegState<S>& leg = work.legs[motor.leg];
    const JacobianRow<S>& row = leg.row[motor.joint];
    const S size = row.n.norm();
    const Vector3<S> n = row.n / size;
    work.A(m) = row.A / size;
    work.B.row(m) << leg.Qb.cross(n).transpose(), n.transpose();  // (paper, eq. 23)
  }
  // Moments are divided by a length of the machine, so the pivots do not depend on the unit of length.
  Matrix6<S> scaled = work.B.transpose();
  scaled.template topRows<3>() /= machine_.length;
  work.B_transposed.compute(scaled);
  const auto pivots = work.B_transposed.matrixLU().diagonal().cwiseAbs();
  legs::requireRegularB<S>(pivots.minCoeff() / pivots.maxCoeff(), motion.t);
}

template <class S>
Matrix6<S> Noc<S>::platformShaping(const NocWorkspace<S>& work) const {
  Matrix6<S> T = work.B_transposed.transpose().solve(Matrix6<S>(work.A.asDiagonal()));  // (paper, eq. 24)
  T.template topRows<3>() /= machine_.length;
  return T;
}

template <class S>
Matrix6<S> Noc<S>::platformShapingRate(const Motion<S>& motion, const NocWorkspace<S>& work) const {
  Matrix6<S> B_dot;
  Vector6<S> A_dot;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = machine_.motors[m];
    const LegState<S>& leg = work.legs[motor.leg];
    const JacobianRow<S>& row = leg.row[motor.joint];
    const S size = row.n.norm();
    const Vector3<S> n = row.n / size, n_dot = row.n_dot / size;  // scaling a row leaves (25) unchanged
    const Vector3<S> Qb_dot = motion.omega.cross(leg.Qb);
    A_dot(m) = row.A_dot / size;
    B_dot.row(m) << (Qb_dot.cross(n) + leg.Qb.cross(n_dot)).transpose(), n_dot.transpose();  // (paper, eq. 26)
  }
  const Matrix6<S> right = Matrix6<S>(A_dot.asDiagonal()) - B_dot * platformShaping(work);
  Matrix6<S> T_dot = work.B_transposed.transpose().solve(right);  // (paper, eq. 25)
  T_dot.template topRows<3>() /= machine_.length;
  return T_dot;
}

}  // namespace ursula
