#include <Eigen/Cholesky>
#include <cmath>

#include "nocsolver/loops/loop_solver_internal.h"
#include "nocsolver/noc/body_equations.h"

namespace ursula {

using loops::CoordinateLoad;
using loops::Frames;
using loops::LoopPose;

namespace {

/// The force of spring, friction and rotor along a coordinate; the spring acts on a coordinate of the file.
double forceOf(const CoordinateLoad& load, double coordinate, double rate, double acceleration) {
  double out = -load.damping * rate - load.rotor * acceleration - load.stiffness * (coordinate - load.spring_reference);
  if (load.friction != 0) out -= load.friction * std::tanh(rate / load.speed);
  return out;
}

/// The tensor of a body in world axes at its pose.
Matrix3d tensorOf(const MechanismBody& body, const BodyState& state) {
  const Matrix3d R = state.displacement.linear();
  return R * body.inertia * R.transpose();
}

}  // namespace

// Joint coordinates that were cut, with the child's turn or slide relative to the parent along the axis a:
//   rate a·(ω_B − ω_A), or a·(v_B − v_A − ω_A × r); a force f along it adds the row's transpose times f.

void LoopSolver::Impl::addCutLoads(const Frames& frames, VectorXd& force, MatrixXd* rotors) const {
  MatrixXd angular(3, tree.rate_count), linear(3, tree.rate_count);
  for (const std::size_t j : tree.cut) {
    const MechanismJoint& joint = mechanism.joints()[j];
    if (!joint.isLoaded()) continue;
    const CoordinateLoad load = loops::loadOf(joint);
    const int parent = tree.element_of_body[joint.parent], child = tree.element_of_body[joint.child];
    const loops::PointMotion A = frames.pointOf(parent, joint.centre), B = frames.pointOf(child, joint.centre_of_child);
    angular.setZero();
    linear.setZero();
    frames.addColumns(child, B.x, 1, angular, linear);
    frames.addColumns(parent, B.x, -1, angular, linear);
    const Matrix3d &R_A = frames.at(parent).R, &R_B = frames.at(child).R;
    const Vector3d r = B.x - A.x, w_r = B.omega - A.omega, v_r = B.v - A.v - A.omega.cross(r);
    const auto add = [&](const Eigen::RowVectorXd& row, double coordinate, double rate, double acceleration) {
      force += row.transpose() * forceOf(load, coordinate, rate, acceleration);
      if (rotors != nullptr) *rotors += load.rotor * row.transpose() * row;
    };
    const Vector3d a = R_A * joint.axis[0];
    if (joint.kind == JointKind::revolute) {
      const Vector3d across = joint.axis[0].unitOrthogonal();
      const Vector3d x = R_A * across, y = R_B * (joint.turn.transpose() * across);
      const double angle = std::atan2(a.dot(x.cross(y)), x.dot(y));
      add(a.transpose() * angular, joint.position + angle, a.dot(w_r),
          a.dot(B.alpha - A.alpha) + A.omega.cross(a).dot(w_r));
    } else if (joint.kind == JointKind::prismatic) {
      const Vector3d a_r = B.a - A.a - A.alpha.cross(r) - A.omega.cross(A.omega.cross(r)) - 2 * A.omega.cross(v_r);
      add(a.transpose() * linear, joint.position + a.dot(r), a.dot(v_r), a.dot(a_r));
    } else if (joint.kind == JointKind::ball) {
      for (int k = 0; k < 3; ++k) {
        const Vector3d n = R_A.col(k);
        add(n.transpose() * angular, 0, n.dot(w_r), n.dot(B.alpha - A.alpha) + A.omega.cross(n).dot(w_r));
      }
    }
  }
}

VectorXd LoopSolver::Impl::loadForces(const Frames& frames, const LoopWork& work) const {
  VectorXd out(tree.rate_count);
  for (const loops::Element& element : tree.elements)
    for (int k = element.first; k < element.first + element.rates(); ++k) {
      CoordinateLoad load = element.load;
      if (element.kind == loops::ElementKind::ball) load.stiffness = 0;
      out(k) = forceOf(load, load.position + work.pose.q(k), work.u(k), work.u_dot(k));
    }
  addCutLoads(frames, out, nullptr);
  return out;
}

VectorXd LoopSolver::inverseDynamics(const MotorMotion& motion, const LoopPose& near, LoopWork& work) const {
  kinematics(motion, near, work);
  const Impl& own = *impl_;
  Frames frames(own.tree);
  frames.place(work.pose);
  frames.move(work.u, work.u_dot);
  VectorXd tau = -work.N.transpose() * own.loadForces(frames, work);
  const auto& bodies = own.mechanism.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const MechanismBody& body = bodies[b];
    if (own.tree.element_of_body[b] < 0 || (body.mass == 0 && body.inertia.isZero(0))) continue;
    const BodyState& state = work.bodies[b];
    const Matrix3d I = tensorOf(body, state);
    const Vector3d omega = state.twist.head<3>();
    Vector6d w = -timesM(I, body.mass, state.twist_rate) -
                 timesW(omega, timesM(I, body.mass, state.twist));             // (paper, eqs. 28, 38)
    if (!body.weightless) w.tail<3>() += body.mass * own.mechanism.gravity();  // (paper, eq. 45)
    tau -= work.T[b].transpose() * w;                                          // (paper, eq. 37)
  }
  return tau;
}

VectorXd LoopSolver::effortScale(const LoopWork& work) const {
  const Impl& own = *impl_;
  Frames frames(own.tree);
  frames.place(work.pose);
  frames.move(work.u, work.u_dot);
  VectorXd out = work.N.cwiseAbs().transpose() * own.loadForces(frames, work).cwiseAbs();
  const auto& bodies = own.mechanism.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (own.tree.element_of_body[b] < 0) continue;
    const Matrix3d I = tensorOf(bodies[b], work.bodies[b]);
    const Vector6d momentum = timesM(I, bodies[b].mass, work.bodies[b].twist);
    const Vector6d rate = timesM(I, bodies[b].mass, work.bodies[b].twist_rate);
    const double moment = rate.head<3>().norm() + momentum.head<3>().norm() * work.bodies[b].twist.head<3>().norm();
    double force = rate.tail<3>().norm();
    if (!bodies[b].weightless) force += bodies[b].mass * own.mechanism.gravity().norm();
    out += moment * work.T[b].topRows<3>().colwise().norm().transpose();
    out += force * work.T[b].bottomRows<3>().colwise().norm().transpose();
  }
  return out;
}

MatrixXd LoopSolver::inertia(const LoopWork& work) const {
  const Impl& own = *impl_;
  Frames frames(own.tree);
  frames.place(work.pose);
  frames.move(work.u, work.u_dot);
  MatrixXd rotors = MatrixXd::Zero(own.tree.rate_count, own.tree.rate_count);
  for (int k = 0; k < own.tree.rate_count; ++k) rotors(k, k) = own.loads[k].rotor;
  VectorXd ignored = VectorXd::Zero(own.tree.rate_count);
  own.addCutLoads(frames, ignored, &rotors);
  MatrixXd I = work.N.transpose() * rotors * work.N;
  const auto& bodies = own.mechanism.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (own.tree.element_of_body[b] < 0) continue;
    const MatrixXd& T = work.T[b];
    const Matrix3d tensor = tensorOf(bodies[b], work.bodies[b]);
    I += T.topRows<3>().transpose() * tensor * T.topRows<3>();  // (paper, eq. 34)
    I += bodies[b].mass * (T.bottomRows<3>().transpose() * T.bottomRows<3>());
  }
  return I;
}

VectorXd LoopSolver::directDynamics(const MotorMotion& motion, const VectorXd& efforts, const LoopPose& near,
                                    LoopWork& work) const {
  MotorMotion unaccelerated = motion;
  unaccelerated.qddot.setZero();
  const VectorXd without = inverseDynamics(unaccelerated, near, work);
  return inertia(work).ldlt().solve(efforts - without);  // (paper, eq. 36)
}

}  // namespace ursula
