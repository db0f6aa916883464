#pragma once

// The twist-shaping matrix T of (32a), column by column as (48) says, its rate, and motions turned into B. Internal.

#include "nocsolver/kernels/leg_kinematics.h"
#include "nocsolver/kernels/link_motion.h"
#include "nocsolver/paper_solver.h"

namespace ursula::kernel {

/// From the axes of Fᵢ to B. `cosine`, `sine` place the link's axis in Fᵢ.
template <class S>
void toBase(const LegModel<S>& leg, const LegState<S>& state, const LinkMotion<S>& link, const S& cosine, const S& sine,
            BodyMotion<S>& body) {
  Matrix3<S> F;
  F << state.x, leg.y_hat, state.z;
  const Vector3<S> axis = cosine * leg.y_hat + sine * state.z;
  body.c = leg.a + F * link.c;                             // (paper, eq. 39)
  body.R << state.x, axis.cross(state.x), axis;            // (paper, eq. 40)
  body.twist << F * link.omega, F * link.c_dot;            // (paper, eq. 41)
  body.twist_rate << F * link.omega_dot, F * link.c_ddot;  // (paper, eq. 43)
}

template <class S>
void platformMotion(const PaperModel<S>& model, const Motion<S>& motion, BodyMotion<S>& body) {
  const Vector3<S> arm = motion.Q * model.rho;
  body.c = motion.p + arm;  // (paper, eq. 39c)
  body.R = motion.Q;
  body.twist << motion.omega, motion.p_dot + motion.omega.cross(arm);  // (paper, eq. 41c)
  body.twist_rate << motion.omega_dot,
      motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm));
}

/// T_P = B⁻¹A. `B_transposed` holds the factors of Bᵀ with its moment rows over `length`.
template <class S>
Matrix6<S> platformShaping(const PaperWorkspace<S>& work, const S& length) {
  Matrix6<S> T = work.B_transposed.transpose().solve(Matrix6<S>(work.A.asDiagonal()));  // (paper, eq. 24)
  T.template topRows<3>() /= length;
  return T;
}

/// Ṫ = B⁻¹(Ȧ − Ḃ T). (25), (26)
template <class S, class R>
Matrix6<S> platformShapingRate(const PaperModel<S>& model, const Motion<S>& motion, const PaperWorkspace<S>& work,
                               const Matrix6<S>& T, const R& reading) {
  Matrix6<S> B_dot;
  Vector6<S> A_dot;
  for (int i = 0; i < leg_count; ++i) {
    const LegState<S>& state = work.legs[static_cast<std::size_t>(i)];
    const Vector3<S> x_dot = state.rate.phi * state.z;  // Q̂ᵢ Ωᵢ Q̂ᵢᵀ xᵢ with (12)
    const Vector3<S> Qb_dot =
        motion.omega.cross(reading.has(Slip::eq26_b_dot) ? model.legs[static_cast<std::size_t>(i)].b : state.Qb);
    A_dot(i) = state.a_ii_dot;
    B_dot.row(i) << (Qb_dot.cross(state.x) + state.Qb.cross(x_dot)).transpose(), x_dot.transpose();  // (paper, eq. 26)
  }
  const Matrix6<S> right = Matrix6<S>(A_dot.asDiagonal()) - B_dot * T;
  Matrix6<S> T_dot = work.B_transposed.transpose().solve(right);  // (paper, eq. 25)
  T_dot.template topRows<3>() /= model.length;
  return T_dot;
}

/// Rates of leg i's joints for φ̇ = e_j: δ_j of (48) at the leg.
template <class S, class R>
JointTriple<S> columnRates(const LegModel<S>& leg, const LegState<S>& state, const Vector6<S>& t_P, bool own,
                           const R& reading, Vector3<S>& h) {
  const Vector3<S> v_B = t_P.template tail<3>() + Vector3<S>(t_P.template head<3>()).cross(state.Qb);
  h = Vector3<S>(state.x.dot(v_B), leg.y_hat.dot(v_B), state.z.dot(v_B));
  JointTriple<S> rate = legRates(leg, state, h, reading);
  rate.phi = S(own ? 1 : 0);  // (paper, eq. 48)
  return rate;
}

template <class S>
void setColumn(TwistShaping<S>& shaping, int body, int column, const Vector3<S>& angular, const Vector3<S>& linear) {
  shaping.template block<6, 1>(6 * body, column) << angular, linear;
}

template <class S, class R>
void twistShaping(const PaperModel<S>& model, const Motion<S>& motion, const PaperWorkspace<S>& work, const R& reading,
                  TwistShaping<S>& shaping) {
  const Matrix6<S> T = platformShaping(work, model.length);
  const Vector3<S> arm = reading.has(Slip::eq47) ? model.rho : Vector3<S>(motion.Q * model.rho);
  LinkMotion<S> proximal, distal;
  for (int j = 0; j < leg_count; ++j) {
    const Vector6<S> t_P = T.col(j);
    const Vector3<S> omega = t_P.template head<3>();
    setColumn<S>(shaping, 2 * leg_count, j, omega, t_P.template tail<3>() + omega.cross(arm));  // (paper, eq. 47)
    for (int i = 0; i < leg_count; ++i) {
      const LegModel<S>& leg = model.legs[static_cast<std::size_t>(i)];
      const LegState<S>& state = work.legs[static_cast<std::size_t>(i)];
      Vector3<S> h;
      const JointTriple<S> rate = columnRates(leg, state, t_P, i == j, reading, h);
      linkMotions(leg, state, rate, JointTriple<S>{}, reading, proximal, distal);
      Matrix3<S> F;
      F << state.x, leg.y_hat, state.z;
      setColumn<S>(shaping, i, j, F * proximal.omega, F * proximal.c_dot);
      setColumn<S>(shaping, leg_count + i, j, F * distal.omega, F * distal.c_dot);
    }
  }
}

/// Ṫ of (32b): the accelerations of (17), (43) at the actual motion for the rates of one column and their rates.
template <class S, class R>
void twistShapingRate(const PaperModel<S>& model, const Motion<S>& motion, const PaperWorkspace<S>& work,
                      const R& reading, TwistShaping<S>& shaping_rate) {
  const Matrix6<S> T = platformShaping(work, model.length);
  const Matrix6<S> T_dot = platformShapingRate(model, motion, work, T, reading);
  const Vector3<S> arm = motion.Q * model.rho;
  LinkMotion<S> proximal, distal;
  for (int j = 0; j < leg_count; ++j) {
    const Vector6<S> t_P = T.col(j), t_P_dot = T_dot.col(j);
    const Vector3<S> omega = t_P.template head<3>(), omega_dot = t_P_dot.template head<3>();
    setColumn<S>(shaping_rate, 2 * leg_count, j, omega_dot,
                 t_P_dot.template tail<3>() + omega_dot.cross(arm) + omega.cross(motion.omega.cross(arm)));
    for (int i = 0; i < leg_count; ++i) {
      const LegModel<S>& leg = model.legs[static_cast<std::size_t>(i)];
      const LegState<S>& state = work.legs[static_cast<std::size_t>(i)];
      Vector3<S> h;
      const JointTriple<S> rate = columnRates(leg, state, t_P, i == j, reading, h);
      const Vector3<S> v_B = t_P.template tail<3>() + omega.cross(state.Qb);
      const Vector3<S> a_B =
          t_P_dot.template tail<3>() + omega_dot.cross(state.Qb) + omega.cross(motion.omega.cross(state.Qb));
      const Vector3<S> h_dot(state.x.dot(a_B) + state.rate.phi * h.z(), leg.y_hat.dot(a_B),
                             state.z.dot(a_B) - state.rate.phi * h.x());
      JointTriple<S> acceleration =
          legAccelerations(leg, state, rate, h_dot, S(state.v_B.dot(v_B) + state.AB.dot(a_B)), reading);
      acceleration.phi = S(0);  // φ̇ = e_j is constant
      linkMotions(leg, state, rate, acceleration, reading, proximal, distal);
      Matrix3<S> F;
      F << state.x, leg.y_hat, state.z;
      setColumn<S>(shaping_rate, i, j, F * proximal.omega_dot, F * proximal.c_ddot);
      setColumn<S>(shaping_rate, leg_count + i, j, F * distal.omega_dot, F * distal.c_ddot);
    }
  }
}

}  // namespace ursula::kernel
