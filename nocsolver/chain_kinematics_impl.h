#pragma once

// Kinematics and Jacobians of ChainSolver; included by chain_solver_impl.h.

#include "nocsolver/chain_solver.h"
#include "nocsolver/kernels/chain_leg.h"
#include "nocsolver/kernels/platform_at_p.h"

namespace ursula {

template <class S, class R>
void ChainSolver<S, R>::place(const Motion<S>& motion, int i, ChainState<S>& out) const {
  chain::displacement(model(i), i, motion, out);
  kernel::placeLinks(model(i), out);
  reading_.placed(model(i), out);
  chain::map(model(i), i, motion.t, out);
  reading_.mapped(model(i), out);
}

template <class S, class R>
void ChainSolver<S, R>::displacements(const Motion<S>& motion, ChainWorkspace<S>& work) const {
  for (int i = 0; i < leg_count_; ++i) place(motion, i, work.legs[chain::at(i)]);
}

template <class S, class R>
void ChainSolver<S, R>::inverseKinematics(const Motion<S>& motion, ChainWorkspace<S>& work) const {
  for (int i = 0; i < leg_count_; ++i) {
    ChainState<S>& leg = work.legs[chain::at(i)];
    place(motion, i, leg);
    const Vector3<S> across = motion.omega.cross(leg.Qb);
    leg.v_B = motion.p_dot + across;
    const Vector3<S> a_B = motion.p_ddot + motion.omega_dot.cross(leg.Qb) + motion.omega.cross(across);
    leg.rate = kernel::chainRates(leg, leg.v_B);
    Vector3<S> bias = chain::motionOf<S>(model(i).kind, leg, leg.rate, Vector3<S>::Zero(), reading_).a_B;
    if (reading_.has(Slip::drop_bias)) bias.setZero();
    leg.acceleration = kernel::chainRates<S>(leg, a_B - bias);
  }
}

template <class S, class R>
JointVariables<S> ChainSolver<S, R>::angles(const ChainWorkspace<S>& work) const {
  using std::atan2;
  JointVariables<S> q;
  for (int i = 0; i < leg_count_; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const ChainState<S>& leg = work.legs[chain::at(i)];
      const Coordinate coordinate = rowOf(model(i).kind).coordinates[j];
      q.of(coordinate)(i) = slides(coordinate) ? leg.cosine[j] : S(atan2(leg.sine[j], leg.cosine[j]));
    }
  return q;
}

template <class S, class R>
JointVariables<S> ChainSolver<S, R>::rates(const ChainWorkspace<S>& work) const {
  JointVariables<S> q;
  for (int i = 0; i < leg_count_; ++i)
    for (int j = 0; j < 3; ++j)
      q.of(rowOf(model(i).kind).coordinates[chain::at(j)])(i) = work.legs[chain::at(i)].rate(j);
  return q;
}

template <class S, class R>
JointVariables<S> ChainSolver<S, R>::accelerations(const ChainWorkspace<S>& work) const {
  JointVariables<S> q;
  for (int i = 0; i < leg_count_; ++i)
    for (int j = 0; j < 3; ++j)
      q.of(rowOf(model(i).kind).coordinates[chain::at(j)])(i) = work.legs[chain::at(i)].acceleration(j);
  return q;
}

template <class S, class R>
void ChainSolver<S, R>::jacobians(const Motion<S>& motion, ChainWorkspace<S>& work) const {
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors_[chain::at(m)];
    const ChainState<S>& leg = work.legs[chain::at(motor.leg)];
    const Vector3<S>& k = leg.k[chain::at(motor.joint)];
    work.A(m) = S(1) / k.cwiseAbs().sum();  // any size near k's will do, and this one needs no root
    const Vector3<S> n = work.A(m) * k;
    if (reading_.has(Slip::eq23)) work.A(m) = k.norm();
    work.B.row(m) << leg.Qb.cross(n).transpose(), n.transpose();  // (23)
  }
  kernel::factorise(work.B, length_, motion.t, work.B_transposed);
}

template <class S, class R>
Matrix6<S> ChainSolver<S, R>::T(const ChainWorkspace<S>& work) const {
  Matrix6<S> T = work.B_transposed.transpose().solve(Matrix6<S>(work.A.asDiagonal()));  // (24)
  T.template topRows<3>() /= length_;
  return T;
}

/// With J = A⁻¹B, J T = 1: Ṫ = −T J̇ T. The rows of J are [Qb × k; k].
template <class S, class R>
Matrix6<S> ChainSolver<S, R>::TRate(const Motion<S>& motion, const ChainWorkspace<S>& work) const {
  Matrix6<S> J_dot;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors_[chain::at(m)];
    const ChainState<S>& leg = work.legs[chain::at(motor.leg)];
    const Matrix3<S> K_dot = kernel::withKind(
        model(motor.leg).kind, [&](auto kind) { return kernel::chainMapRate<decltype(kind)::value>(leg); });
    const Vector3<S>& k = leg.k[chain::at(motor.joint)];
    const Vector3<S> k_dot =
        reading_.has(Slip::drop_map_rate) ? Vector3<S>(Vector3<S>::Zero()) : Vector3<S>(K_dot.row(motor.joint));
    const Vector3<S> Qb_dot =
        reading_.has(Slip::eq26_b_dot) ? Vector3<S>(Vector3<S>::Zero()) : Vector3<S>(motion.omega.cross(leg.Qb));
    J_dot.row(m) << (Qb_dot.cross(k) + leg.Qb.cross(k_dot)).transpose(), k_dot.transpose();  // (26)
  }
  const Matrix6<S> T = this->T(work);
  return -T * J_dot * T;  // (25)
}

}  // namespace ursula
