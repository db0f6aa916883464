#pragma once

// Bodies of ChainSolver; included by the sources that instantiate it.

#include <Eigen/Cholesky>

#include "nocsolver/chain_kinematics_impl.h"
#include "nocsolver/kernels/platform_at_p.h"

namespace ursula {

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
    const ChainState<S>& leg = work.legs[chain::at(i)];
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

/// The wrench at P of all that no motor carries directly, and what falls on the motors.
template <class S, class R>
Vector6<S> ChainSolver<S, R>::wrenchAtP(const Motion<S>& motion, const ChainWorkspace<S>& work,
                                        Vector6<S>& Q_driven) const {
  Vector6<S> wrench = platformWrench(motion);
  for (int i = 0; i < leg_count_; ++i) {
    const ChainState<S>& leg = work.legs[chain::at(i)];
    const Vector3<S> Q = legForces(work, i);
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
  inverseKinematics(motion, work);
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
    const ChainState<S>& leg = work.legs[chain::at(i)];
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
  inverseKinematics(unaccelerated, work);
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
