#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "nocsolver/loops/loop_solver_internal.h"

namespace ursula {

using loops::Frames;
using loops::LoopPose;
using loops::PassiveRates;

// Featherstone, Rigid Body Dynamics Algorithms, ch. 8. With passive rates u_p, and G = [G_a G_p] of the closures,
//   G_a q̇ + G_p u_p = 0:       u = N q̇,       N = [1; −G_p⁺ G_a]                                   (a)
//   G u̇ + Ġu = 0:              u̇ = N q̈ + b,   b = [0; −G_p⁺ (Ġu)]                                  (b)
// A body's twist is t = J u; so T = J N, and ṫ = T q̈ + J b + J̇u.                                    (c)
// Idle spins are at rest: with Z the kernel of G_p and S u the spins û·ω,
//   u becomes u − Z (S Z)⁺ S u, and u̇ becomes u̇ − Z (S Z)⁺ (S u̇ + Ṡ u).                            (d)

void LoopSolver::Impl::stopSpins(const Frames& frames, const PassiveRates& solver, bool accelerations,
                                 MatrixXd& u) const {
  if (spins.empty()) return;
  const MatrixXd Z = solver.kernel(tree.rate_count);
  MatrixXd S = MatrixXd::Zero(static_cast<Eigen::Index>(spins.size()), tree.rate_count);
  MatrixXd spin(S.rows(), u.cols());
  MatrixXd angular(3, tree.rate_count), linear(3, tree.rate_count);
  for (std::size_t i = 0; i < spins.size(); ++i) {
    angular.setZero();
    linear.setZero();
    const loops::FrameState& frame = frames.at(spins[i].element);
    frames.addColumns(spins[i].element, frame.point, 1, angular, linear);
    const Vector3d axis = frame.R * spins[i].axis;
    const auto row = static_cast<Eigen::Index>(i);
    S.row(row) = axis.transpose() * angular;
    spin.row(row) = S.row(row) * u;
    // d(û·ω)/dt = û·α + (ω × û)·ω = û·α
    if (accelerations) spin.row(row).array() += axis.dot(frame.alpha);
  }
  const MatrixXd own = S * Z;
  u -= Z * leastNormSolution(own, spin);  // (d)
}

void LoopSolver::Impl::complement(const Frames& frames, const MatrixXd& G, const PassiveRates& solver,
                                  MatrixXd& N) const {
  N.setZero(tree.rate_count, motors());
  MatrixXd G_a(G.rows(), motors());
  for (int k = 0; k < motors(); ++k) {
    G_a.col(k) = G.col(tree.rate_of_motor[k]);
    N(tree.rate_of_motor[k], k) = 1;
  }
  const MatrixXd own = solver.solve(-G_a);  // (a)
  for (std::size_t i = 0; i < passive.size(); ++i) N.row(passive[i]) = own.row(static_cast<Eigen::Index>(i));
  stopSpins(frames, solver, false, N);
}

VectorXd LoopSolver::Impl::bias(const Frames& frames, const PassiveRates& solver) const {
  VectorXd gamma = VectorXd::Zero(closures.rows());
  closures.bias(frames, gamma);
  MatrixXd b = MatrixXd::Zero(tree.rate_count, 1);
  const MatrixXd own = solver.solve(-gamma);  // (b)
  for (std::size_t i = 0; i < passive.size(); ++i) b(passive[i], 0) = own(static_cast<Eigen::Index>(i), 0);
  stopSpins(frames, solver, true, b);
  return b;
}

void LoopSolver::Impl::fill(const MotorMotion& motion, const LoopPose& near, Frames& frames, LoopWork& work) const {
  if (work.u.size() != tree.rate_count) work = LoopWork();  // it was another mechanism's
  work.pose = near;
  for (int k = 0; k < motors(); ++k) work.pose.q(tree.rate_of_motor[k]) = motion.q(k) - mechanism.motor(k).position;
  PassiveRates solver = rates;
  const double moved = close(work.pose, frames, solver, 12);
  work.closing = errorOf(frames, nullptr);
  if (!std::isfinite(moved) || work.closing > 1e-6) refuse(work.pose, "the loops cannot be closed");
  MatrixXd G(closures.rows(), tree.rate_count);
  closures.jacobian(frames, G);
  if (!solver.factorise(G)) throw LoopError(singular_pose);
  work.reciprocal_condition = solver.reciprocalCondition();
  complement(frames, G, solver, work.N);
  work.u = work.N * motion.qdot;
  frames.move(work.u, VectorXd::Zero(tree.rate_count));
  work.u_dot = work.N * motion.qddot + bias(frames, solver);
  frames.move(work.u, work.u_dot);
}

void LoopSolver::kinematics(const MotorMotion& motion, const LoopPose& near, LoopWork& work) const {
  const Impl& own = *impl_;
  Frames frames(own.tree);
  own.fill(motion, near, frames, work);
  const auto& bodies = own.mechanism.bodies();
  work.bodies.assign(bodies.size(), BodyState());
  work.T.assign(bodies.size(), MatrixXd());
  MatrixXd J(6, own.tree.rate_count);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int element = own.tree.element_of_body[b];
    BodyState& state = work.bodies[b];
    const loops::PointMotion point = frames.pointOf(element, bodies[b].center_of_mass);
    state.displacement = frames.displacement(element);
    state.center = point.x;
    state.twist << point.omega, point.v;
    state.twist_rate << point.alpha, point.a;
    J.setZero();
    frames.addColumns(element, point.x, 1, J.topRows<3>(), J.bottomRows<3>());
    work.T[b] = J * work.N;  // (c)
  }
}

void moveToStart(const LoopSolver& solver, const MotorTrajectory& trajectory, LoopPose& pose) {
  try {
    solver.moveTo(trajectory.at(0).q, pose, true);
  } catch (const LoopError& error) {
    throw LoopError(std::string(error.what()) + ", on the way from the file's pose to t = 0 s");
  }
}

LoopMotion::LoopMotion(const LoopSolver& solver, const MotorTrajectory& trajectory, LoopPose start)
    : solver_(&solver), trajectory_(&trajectory) {
  moveToStart(solver, trajectory, start);
  times_.push_back(0);
  poses_.push_back(std::move(start));
  constexpr int steps = 128;
  for (int k = 0; k < steps; ++k) follow(trajectory.duration() * k / steps, trajectory.duration() * (k + 1) / steps, 0);
}

void LoopMotion::follow(double from, double to, int depth) {
  constexpr int deepest = 10;
  LoopPose pose = poses_.back();
  try {
    solver_->moveTo(trajectory_->at(to).q, pose, true);
  } catch (const LoopError& error) {
    if (depth == deepest) throw LoopError(std::string(error.what()) + ", at t = " + std::to_string(to) + " s");
    const double middle = from + (to - from) / 2;
    follow(from, middle, depth + 1);
    follow(middle, to, depth + 1);
    return;
  }
  times_.push_back(to);
  poses_.push_back(pose);
}

const LoopPose& LoopMotion::near(double t) const {
  const auto after = std::upper_bound(times_.begin() + 1, times_.end(), t);
  return poses_[after - times_.begin() - 1];
}

VectorXd LoopMotion::inverseDynamics(double t, LoopWork& work) const {
  const MotorMotion motion = trajectory_->at(t);
  try {
    LoopPose pose = near(t);
    solver_->moveTo(motion.q, pose);
    VectorXd out = solver_->inverseDynamics(motion, pose, work);
    if (!out.allFinite()) throw LoopError("the motion needs efforts beyond all numbers");
    return out;
  } catch (const LoopError& error) {
    throw LoopError(std::string(error.what()) + ", at t = " + std::to_string(t) + " s");
  }
}

}  // namespace ursula
