#pragma once

// Bodies of ChainSolver; included by the sources that instantiate it.

#include <Eigen/Cholesky>
#include <algorithm>

#include "nocsolver/chain_solver.h"
#include "nocsolver/kernels/chain_leg.h"
#include "nocsolver/kernels/leg_forces.h"
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
void ChainSolver<S, R>::maps(const Motion<S>& motion, ChainWorkspace<S>& work) const {
  for (int i = 0; i < leg_count_; ++i) {
    chain::displacement(model(i), i, motion, work.legs[chain::at(i)]);
    chain::map(model(i), i, motion.t, work.legs[chain::at(i)]);
  }
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
ChainState<S> ChainSolver<S, R>::placed(const ChainWorkspace<S>& work, int i) const {
  ChainState<S> leg = work.legs[chain::at(i)];
  if (is_right) kernel::placeLinks(model(i), leg);
  return leg;
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
    const ChainState<S> leg = placed(work, motor.leg);
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

template <class S, class R>
void ChainSolver<S, R>::bodyMotions(const Motion<S>& motion, const ChainWorkspace<S>& work,
                                    BodyMotions<S>& bodies) const {
  bodies = BodyMotions<S>();
  for (int i = 0; i < leg_count_; ++i) {
    const ChainState<S>& leg = work.legs[chain::at(i)];
    const kernel::ChainMotion<S> links = chain::motionOf<S>(model(i).kind, leg, leg.rate, leg.acceleration, reading_);
    const auto set = [&](BodyMotion<S>& body, const Vector3<S>& c, const Matrix3<S>& frame,
                         const ChainLinkMotion<S>& m) {
      body.c = model(i).a + c;
      body.R = frame;
      body.twist << m.omega, m.c_dot;
      body.twist_rate << m.omega_dot, m.c_ddot;
    };
    set(bodies[chain::at(i)], leg.O_1 + leg.arm_1, leg.R_1, links.proximal);
    set(bodies[chain::at(leg_count + i)], leg.O_2 + leg.arm_2, leg.R_2, links.distal);
  }
  const Vector3<S> arm = motion.Q * rho_;
  BodyMotion<S>& platform = bodies.back();
  platform.c = motion.p + arm;  // (39c)
  platform.R = motion.Q;
  platform.twist << motion.omega, motion.p_dot + motion.omega.cross(arm);  // (41c)
  platform.twist_rate << motion.omega_dot,
      motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm));
}

template <class S, class R>
void ChainSolver<S, R>::twistShaping(const Motion<S>& motion, const ChainWorkspace<S>& work,
                                     Eigen::Matrix<S, 6 * body_count, motor_count>& shaping) const {
  const Matrix6<S> T = this->T(work);
  const Vector3<S> arm = motion.Q * rho_;
  shaping.setZero();
  for (int i = 0; i < leg_count_; ++i) {
    const ChainState<S> leg = placed(work, i);
    const kernel::ChainPartials<S> partials =
        kernel::withKind(model(i).kind, [&](auto kind) { return kernel::chainPartials<decltype(kind)::value>(leg); });
    for (int m = 0; m < motor_count; ++m) {
      const Vector3<S> rate = kernel::chainRates(leg, chain::atB<S>(T.col(m), leg.Qb));
      shaping.template block<6, 1>(6 * i, m) << partials.omega_1 * rate, partials.v_1 * rate;  // (48)
      shaping.template block<6, 1>(6 * (leg_count + i), m) << partials.omega_2 * rate, partials.v_2 * rate;
    }
  }
  for (int m = 0; m < motor_count; ++m)
    shaping.template block<6, 1>(12 * leg_count, m) << T.col(m).template head<3>(), chain::atB<S>(T.col(m), arm);
}

template <class S, class R>
Vector3<S> ChainSolver<S, R>::legForces(const ChainWorkspace<S>& work, int i) const {
  const ChainState<S>& leg = work.legs[chain::at(i)];
  return kernel::withKind(model(i).kind, [&](auto k) {
    constexpr LegKind kind = decltype(k)::value;
    return kernel::chainForces<kind>(
        model(i), leg, kernel::chainMotion<kind>(leg, leg.rate, leg.acceleration, reading_), gravity_, reading_);
  });
}

/// [moment about P; force], in B, that moves the platform as it moves against gravity. (38), (43c), (46c)
template <class S, class R>
Vector6<S> ChainSolver<S, R>::platformWrench(const Motion<S>& motion) const {
  const Vector3<S> arm = motion.Q * rho_;
  Vector3<S> c_ddot = motion.p_ddot + motion.omega_dot.cross(arm);
  if (!reading_.has(Slip::drop_platform_centripetal)) c_ddot += motion.omega.cross(motion.omega.cross(arm));
  const Vector3<S> omega_M = motion.Q.transpose() * motion.omega;
  Vector3<S> n_M = I_M_ * (motion.Q.transpose() * motion.omega_dot);
  if (!reading_.has(Slip::drop_gyroscopic_platform)) n_M += omega_M.cross(I_M_ * omega_M);
  if (!reading_.has(Slip::drop_gravity_platform)) c_ddot -= gravity_;
  const Vector3<S> f = mass_ * c_ddot;
  Vector6<S> wrench;
  wrench << motion.Q * n_M + arm.cross(f), f;
  return wrench;
}

template <class S, class R>
Vector3<S> ChainSolver<S, R>::planeForces(const Motion<S>& motion, int i, ChainState<S>& leg) const {
  const Vector3<S> across = motion.omega.cross(leg.Qb);
  leg.v_B = motion.p_dot + across;
  const Vector3<S> a_B = motion.p_ddot + motion.omega_dot.cross(leg.Qb) + motion.omega.cross(across);
  const auto forces = [&]() -> Vector3<S> {
    switch (model(i).kind) {
      case LegKind::UPS:
        return kernel::upsForces(model(i), a_B, gravity_, leg);
      case LegKind::RUS:
        return kernel::rusForces(model(i), a_B, gravity_, leg);
      case LegKind::PUS:
        return kernel::pusForces(model(i), a_B, gravity_, leg);
      case LegKind::URS:
        break;
    }
    return kernel::ursForces(model(i), a_B, gravity_, leg);
  };
  const Vector3<S> Q = forces();  // which finds the rates that rub
  return Q + kernel::chainFriction(model(i), leg);
}

/// The wrench at P of all that no motor carries directly, and what falls on the motors.
template <class S, class R>
Vector6<S> ChainSolver<S, R>::wrenchAtP(const Motion<S>& motion, ChainWorkspace<S>& work, Vector6<S>& Q_driven) const {
  Vector6<S> wrench = platformWrench(motion);
  for (int i = 0; i < leg_count_; ++i) {
    ChainState<S>& leg = work.legs[chain::at(i)];
    const Vector3<S> Q = is_right ? planeForces(motion, i, leg) : legForces(work, i);
    Vector3<S> f = Vector3<S>::Zero();
    for (int j = 0; j < 3; ++j) {
      const int motor = model(i).motor[chain::at(j)];
      if (motor >= 0)
        Q_driven(motor) = reading_.has(Slip::drop_own_share) ? S(0) : Q(j);
      else if (!reading_.has(Slip::drop_passive_share))
        f += Q(j) * leg.k[chain::at(j)];
    }
    chain::addForceAtB<S>(f, leg.Qb, wrench);
  }
  return wrench;
}

template <class S, class R>
Vector6<S> ChainSolver<S, R>::inverseDynamics(const Motion<S>& motion, ChainWorkspace<S>& work,
                                              const Vector6<S>& load) const {
  is_right ? maps(motion, work) : inverseKinematics(motion, work);
  jacobians(motion, work);
  Vector6<S> Q_driven;
  Vector6<S> wrench = wrenchAtP(motion, work, Q_driven) - load;
  wrench.template head<3>() /= length_;
  const Vector6<S> lambda = work.B_transposed.solve(wrench);
  return Q_driven + work.A.cwiseProduct(lambda);  // (37)
}

template <class S, class R>
Matrix6<S> ChainSolver<S, R>::massMatrixAtP(const Motion<S>& motion, const ChainWorkspace<S>& work) const {
  Matrix6<S> M_P = Matrix6<S>::Zero();
  kernel::addAtP<S>(mass_ * Matrix3<S>::Identity(), motion.Q * rho_, M_P);
  M_P.template topLeftCorner<3, 3>() += motion.Q * I_M_ * motion.Q.transpose();
  for (int i = 0; i < leg_count_; ++i) {
    const ChainState<S> leg = placed(work, i);
    const Matrix3<S> M = kernel::withKind(
        model(i).kind, [&](auto kind) { return kernel::chainMassMatrix<decltype(kind)::value>(model(i), leg); });
    Matrix3<S> K_transposed;
    K_transposed << leg.k[0], leg.k[1], leg.k[2];
    kernel::addAtP<S>(K_transposed * M * K_transposed.transpose(), leg.Qb, M_P);
  }
  return M_P;
}

template <class S, class R>
Vector6<S> ChainSolver<S, R>::directDynamics(const Motion<S>& motion, const Vector6<S>& efforts,
                                             ChainWorkspace<S>& work, const Vector6<S>& load) const {
  Motion<S> unaccelerated = motion;
  unaccelerated.omega_dot.setZero();
  unaccelerated.p_ddot.setZero();
  is_right ? maps(unaccelerated, work) : inverseKinematics(unaccelerated, work);
  Vector6<S> Q_driven;
  Vector6<S> wrench = load - wrenchAtP(unaccelerated, work, Q_driven);
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = motors_[chain::at(m)];
    const ChainState<S>& leg = work.legs[chain::at(motor.leg)];
    chain::addForceAtB<S>((efforts(m) - Q_driven(m)) * leg.k[chain::at(motor.joint)], leg.Qb, wrench);
  }
  return massMatrixAtP(unaccelerated, work).llt().solve(wrench);  // (36)
}

template <class S, class R>
Vector3<S> ChainSolver<S, R>::forceOnPlatform(const ChainWorkspace<S>& work, int i, const Vector6<S>& efforts) const {
  const ChainState<S>& leg = work.legs[chain::at(i)];
  const Vector3<S> Q = legForces(work, i);
  Vector3<S> f = Vector3<S>::Zero();
  for (int j = 0; j < 3; ++j) {
    const int motor = model(i).motor[chain::at(j)];
    f += ((motor >= 0 ? efforts(motor) : S(0)) - Q(j)) * leg.k[chain::at(j)];
  }
  return f;
}

}  // namespace ursula
