#pragma once

// Bodies of PaperSolver; included by the sources that instantiate it.

#include <limits>

#include "nocsolver/kernels/direct_dynamics.h"
#include "nocsolver/kernels/dynamics.h"
#include "nocsolver/kernels/leg_kinematics.h"
#include "nocsolver/kernels/link_motion.h"
#include "nocsolver/kernels/shaping.h"
#include "nocsolver/paper_solver.h"

namespace ursula {

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class S, class R>
PaperSolver<S, R>::PaperSolver(const Manipulator& manipulator, R reading)
    : model_(manipulator, reading.has(Slip::eq2)), reading_(reading) {}

template <class S, class R>
void PaperSolver<S, R>::displacements(const Motion<S>& motion, PaperWorkspace<S>& work) const {
  for (int i = 0; i < leg_count; ++i)
    kernel::legDisplacement(model_.legs[at(i)], i, motion, reading_, work.legs[at(i)]);
}

template <class S, class R>
void PaperSolver<S, R>::inverseKinematics(const Motion<S>& motion, PaperWorkspace<S>& work) const {
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = model_.legs[at(i)];
    LegState<S>& state = work.legs[at(i)];
    kernel::legDisplacement(leg, i, motion, reading_, state);
    kernel::requireBentKnee(state, i, motion.t);
    kernel::legVelocity(leg, motion, reading_, state);
    kernel::legAcceleration(leg, motion, reading_, state);
  }
}

template <class S, class R>
JointVariables<S> PaperSolver<S, R>::angles(const PaperWorkspace<S>& work) const {
  using std::atan2;
  JointVariables<S> q;
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = model_.legs[at(i)];
    const LegState<S>& state = work.legs[at(i)];
    const S y = reading_.has(Slip::eq14b) ? S(-state.k_y) : state.k_y;
    q.phi(i) = atan2(state.sin_phi, state.cos_phi);        // (paper, eq. 14a)
    q.theta(i) = atan2(state.sin_theta, state.cos_theta);  // (paper, eq. 4a)
    q.psi(i) =
        atan2(S(leg.s * state.sin_theta), S(leg.l - leg.s * state.cos_theta)) + atan2(state.r, y);  // (paper, eq. 14b)
  }
  return q;
}

template <class S, class R>
JointVariables<S> PaperSolver<S, R>::rates(const PaperWorkspace<S>& work) const {
  JointVariables<S> q;
  for (int i = 0; i < leg_count; ++i) {
    const JointTriple<S>& rate = work.legs[at(i)].rate;
    q.phi(i) = rate.phi;
    q.psi(i) = rate.psi;
    q.theta(i) = rate.theta;
  }
  return q;
}

template <class S, class R>
JointVariables<S> PaperSolver<S, R>::accelerations(const PaperWorkspace<S>& work) const {
  JointVariables<S> q;
  for (int i = 0; i < leg_count; ++i) {
    const JointTriple<S>& acceleration = work.legs[at(i)].acceleration;
    q.phi(i) = acceleration.phi;
    q.psi(i) = acceleration.psi;
    q.theta(i) = acceleration.theta;
  }
  return q;
}

template <class S, class R>
void PaperSolver<S, R>::jacobians(const Motion<S>& motion, PaperWorkspace<S>& work) const {
  for (int i = 0; i < leg_count; ++i) {
    const LegState<S>& state = work.legs[at(i)];
    work.A(i) = state.a_ii;
    work.B.row(i) << state.Qb.cross(state.x).transpose(), state.x.transpose();  // (paper, eq. 23)
  }
  kernel::factorise(work.B, model_.length, motion.t, work.B_transposed);
}

template <class S, class R>
Matrix6<S> PaperSolver<S, R>::T(const PaperWorkspace<S>& work) const {
  return kernel::platformShaping(work, model_.length);
}

template <class S, class R>
Matrix6<S> PaperSolver<S, R>::TRate(const Motion<S>& motion, const PaperWorkspace<S>& work) const {
  return kernel::platformShapingRate(model_, motion, work, kernel::platformShaping(work, model_.length), reading_);
}

template <class S, class R>
void PaperSolver<S, R>::bodyMotions(const Motion<S>& motion, PaperWorkspace<S>& work, BodyMotions<S>& bodies) const {
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = model_.legs[at(i)];
    const LegState<S>& state = work.legs[at(i)];
    kernel::linkMotions(leg, state, state.rate, state.acceleration, reading_, work.proximal[at(i)], work.distal[at(i)]);
    kernel::toBase(leg, state, work.proximal[at(i)], state.cos_psi, state.sin_psi, bodies[at(i)]);
    kernel::toBase(leg, state, work.distal[at(i)], S(-state.cos_sum), S(-state.sin_sum), bodies[at(leg_count + i)]);
  }
  kernel::platformMotion(model_, motion, bodies.back());
}

template <class S, class R>
void PaperSolver<S, R>::twistShaping(const Motion<S>& motion, const PaperWorkspace<S>& work,
                                     TwistShaping<S>& shaping) const {
  kernel::twistShaping(model_, motion, work, reading_, shaping);
}

template <class S, class R>
void PaperSolver<S, R>::twistShapingRate(const Motion<S>& motion, const PaperWorkspace<S>& work,
                                         TwistShaping<S>& shaping_rate) const {
  kernel::twistShapingRate(model_, motion, work, reading_, shaping_rate);
}

/// w of (a) in dynamics.h, and what falls on the actuated joints directly.
template <class S, class R>
Vector6<S> PaperSolver<S, R>::wrenchAtP(const Motion<S>& motion, PaperWorkspace<S>& work, Vector6<S>& Q_phi) const {
  Vector6<S> wrench = kernel::platformWrench(model_, motion, reading_);
  for (int i = 0; i < leg_count; ++i) {
    const LegModel<S>& leg = model_.legs[at(i)];
    const LegState<S>& state = work.legs[at(i)];
    kernel::linkMotions(leg, state, state.rate, state.acceleration, reading_, work.proximal[at(i)], work.distal[at(i)]);
    const JointTriple<S> Q =
        kernel::legForces(leg, state, work.proximal[at(i)], work.distal[at(i)], model_.gravity, reading_);
    Q_phi(i) = Q.phi;
    const Vector3<S> f = kernel::forceAtB(leg, state, Q);
    wrench.template head<3>() += state.Qb.cross(f);
    wrench.template tail<3>() += f;
  }
  return wrench;
}

template <class S, class R>
Vector6<S> PaperSolver<S, R>::inverseDynamics(const Motion<S>& motion, PaperWorkspace<S>& work,
                                              const Vector6<S>& load) const {
  inverseKinematics(motion, work);
  jacobians(motion, work);
  Vector6<S> Q_phi;
  Vector6<S> wrench = wrenchAtP(motion, work, Q_phi) - load;
  wrench.template head<3>() /= model_.length;
  const Vector6<S> lambda = work.B_transposed.solve(wrench);
  return Q_phi + work.A.cwiseProduct(lambda);  // (paper, eq. 37)
}

template <class S, class R>
Matrix6<S> PaperSolver<S, R>::massMatrixAtP(const Motion<S>& motion, const PaperWorkspace<S>& work) const {
  return kernel::massMatrixAtP(model_, motion, work);
}

template <class S, class R>
Vector6<S> PaperSolver<S, R>::directDynamics(const Motion<S>& motion, const Vector6<S>& torques,
                                             PaperWorkspace<S>& work, const Vector6<S>& load) const {
  Motion<S> unaccelerated = motion;
  unaccelerated.omega_dot.setZero();
  unaccelerated.p_ddot.setZero();
  inverseKinematics(unaccelerated, work);
  Vector6<S> Q_phi;
  Vector6<S> wrench = load - wrenchAtP(unaccelerated, work, Q_phi);
  for (int i = 0; i < leg_count; ++i) {
    const LegState<S>& state = work.legs[at(i)];
    const Vector3<S> f = ((torques(i) - Q_phi(i)) / state.a_ii) * state.x;  // BᵀA⁻¹
    wrench.template head<3>() += state.Qb.cross(f);
    wrench.template tail<3>() += f;
  }
  const Matrix6<S> M_P = kernel::massMatrixAtP(model_, unaccelerated, work);
  return M_P.llt().solve(wrench);  // (paper, eq. 36)
}

}  // namespace ursula
