#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/text.h"
#include "nocsolver/loops/loop_solver_internal.h"

namespace ursula {

using loops::Frames;
using loops::LoopPose;

namespace {

constexpr double negligible = 1e-7;  ///< of a kernel's motion, beside its largest

/// The twists [ω; v of the mass centre] of a lump for the columns of Z, at the placed frames.
MatrixXd twists(const Frames& frames, int element, const Lump& lump, const MatrixXd& Z, double length) {
  MatrixXd J = MatrixXd::Zero(6, Z.rows());
  const Vector3d center = frames.at(element).R * lump.center + frames.at(element).d;
  frames.addColumns(element, center, 1, J.topRows<3>(), J.bottomRows<3>());
  J.bottomRows<3>() /= length;
  return J * Z;
}

/// Returns the lines about which the lump spins, in world axes, if that is all it does and changes nothing: one of its
/// symmetry, or three of a ball.
std::vector<Vector3d> idleLines(const MatrixXd& twist, const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> angular(Matrix3d(twist.topRows<3>() * twist.topRows<3>().transpose()));
  const Vector3d squares = angular.eigenvalues();
  const double least = negligible * negligible * squares(2);
  if (!(squares(2) > 0) || twist.bottomRows<3>().squaredNorm() > least) return {};
  const Vector3d axis = angular.eigenvectors().col(2), x = axis.unitOrthogonal(), y = axis.cross(x);
  const double axial = axis.dot(inertia * axis), across = x.dot(inertia * x);
  double apart = std::abs(across - y.dot(inertia * y)) + std::abs(x.dot(inertia * y)) +
                 std::abs(x.dot(inertia * axis)) + std::abs(y.dot(inertia * axis));
  std::vector<Vector3d> out = {axis};
  if (squares(1) > least) {
    if (!(squares(0) > least)) return {};
    apart += std::abs(axial - across);
    out = {axis, x, y};
  }
  return apart <= 1e-6 * inertia.cwiseAbs().maxCoeff() ? out : std::vector<Vector3d>();
}

void addRows(const MatrixXd& rows, MatrixXd& stack) {
  stack.conservativeResize(stack.rows() + rows.rows(), rows.cols());
  stack.bottomRows(rows.rows()) = rows;
}

/// Names the joints that move most in the columns of Z.
std::vector<std::string> movers(const Mechanism& mechanism, const loops::LoopTree& tree, const MatrixXd& Z,
                                const VectorXd& scale) {
  std::vector<std::string> out;
  const VectorXd size = Z.rowwise().norm().cwiseQuotient(scale);
  const double largest = size.size() > 0 ? size.maxCoeff() : 0;
  for (const loops::Element& element : tree.elements) {
    if (element.joint >= mechanism.joints().size()) continue;
    const double own = size.segment(element.first, element.rates()).maxCoeff();
    const std::string name = mechanism.joints()[element.joint].name;
    if (own > 0.3 * largest && std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  }
  for (const loops::Element& element : tree.elements)
    if (element.joint >= mechanism.joints().size() && size.segment(element.first, element.rates()).maxCoeff() > 0)
      out.push_back("a body that no joint connects with the base");
  return out;
}

}  // namespace

void LoopSolver::Impl::findFreedoms(const LoopPose& pose, LoopFreedoms& out, std::vector<RestingSpin>& idle) const {
  Frames frames(tree);
  frames.place(pose);
  MatrixXd G(closures.rows(), tree.rate_count);
  closures.jacobian(frames, G);
  loops::PassiveRates own(passive, scale);
  own.decideRank(G);
  static_cast<void>(own.factorise(G));
  const MatrixXd Z = own.kernel(tree.rate_count);
  MatrixXd stack(0, Z.cols());
  idle.clear();
  for (std::size_t e = 0; e < lumps.size() && Z.cols() > 0; ++e) {
    if (lumps[e].isEmpty()) continue;
    const auto element = static_cast<int>(e);
    const MatrixXd twist = twists(frames, element, lumps[e], Z, mechanism.length());
    if (twist.norm() < negligible * Z.norm()) continue;
    const Matrix3d R = frames.at(element).R;
    const std::vector<Vector3d> lines = idleLines(twist, R * lumps[e].inertia * R.transpose());
    for (const Vector3d& line : lines) idle.push_back({element, R.transpose() * line});
    if (lines.empty()) addRows(twist, stack);
    for (const std::size_t b : lumps[e].bodies)
      if (!lines.empty())
        out.idle.push_back(
            {b, mechanism.bodies()[b].name, lines.size() == 1 ? idle.back().axis : Vector3d(Vector3d::Zero())});
  }
  // A spin that damping, friction, a spring or a rotor feels has an effect. The tree keeps the joints that have these:
  // a motion of one that is cut moves another of its loop.
  for (int k = 0; k < tree.rate_count && Z.cols() > 0; ++k)
    if (loads[k].acts() && Z.row(k).norm() > negligible * scale(k)) addRows(Z.row(k) / scale(k), stack);
  out.free = stack.rows() > 0 ? loops::rankByGap(stack).rank : 0;
  // What moves in the kernel without a body that weighs anything, or a load, has no effect either.
  if (out.free > 0)  // the motions that the rows see
    out.free_joints = movers(mechanism, tree, Z * rightSingularVectors(stack).leftCols(out.free), scale);
  MatrixXd scaled = G;
  for (int k = 0; k < tree.rate_count; ++k) scaled.col(k) *= scale(k);
  const int rank = loops::rankByGap(scaled).rank;
  out.contradicted = rank - own.rank();
  out.freedoms = motors() - out.contradicted + out.free;
  if (out.contradicted <= 0) return;
  // A motor fights if the passive joints cannot give way to it: what G_p x = −G_a leaves.
  for (int k = 0; k < motors(); ++k) {
    const int rate = tree.rate_of_motor[k];
    const VectorXd wanted = G.col(rate);
    const MatrixXd x = own.solve(-wanted);
    VectorXd left = wanted;
    for (std::size_t i = 0; i < passive.size(); ++i) left += G.col(passive[i]) * x(static_cast<Eigen::Index>(i), 0);
    if (left.norm() > negligible * std::max(1.0, wanted.norm())) out.fighting.push_back(mechanism.motor(k).name);
  }
}

std::vector<std::string> LoopFreedoms::idleNames() const {
  std::vector<std::string> out;
  for (const IdleBody& each : idle) out.push_back(each.name);
  return out;
}

const IdleBody* LoopFreedoms::idleBody(std::size_t body) const {
  const auto found = std::find_if(idle.begin(), idle.end(), [&](const IdleBody& each) { return each.body == body; });
  return found == idle.end() ? nullptr : &*found;
}

namespace {

/// Quaternion [w, x, y, z] of R in the child's own axes, with its derivatives for the relative motion of A and B.
struct QuaternionMotion {
  Eigen::Quaterniond q, rate, acceleration;
};

QuaternionMotion quaternionOf(const Matrix3d& turn, const Vector3d& w, const Vector3d& w_dot, const Matrix3d& axes) {
  QuaternionMotion out;
  out.q = Eigen::Quaterniond(turn);
  if (out.q.w() < 0) out.q.coeffs() *= -1;
  const auto half = [](const Vector3d& v) { return Eigen::Quaterniond(0, v.x() / 2, v.y() / 2, v.z() / 2); };
  out.rate = half(w) * out.q;
  out.acceleration.coeffs() = (half(w_dot) * out.q).coeffs() + (half(w) * out.rate).coeffs();
  for (Eigen::Quaterniond* each : {&out.q, &out.rate, &out.acceleration})
    each->vec() = (axes.transpose() * each->vec()).eval();
  return out;
}

void addQuaternion(const std::string& name, const QuaternionMotion& motion, std::vector<LoopSolver::JointValue>& out) {
  out.push_back({name + "_w", motion.q.w(), motion.rate.w(), motion.acceleration.w()});
  for (int k = 0; k < 3; ++k)
    out.push_back(
        {fmt::format("{}_{}", name, "xyz"[k]), motion.q.vec()(k), motion.rate.vec()(k), motion.acceleration.vec()(k)});
}

}  // namespace

std::vector<LoopSolver::JointValue> LoopSolver::joints(const LoopWork& work) const {
  const Impl& own = *impl_;
  Frames frames(own.tree);
  frames.place(work.pose);
  frames.move(work.u, work.u_dot);
  std::vector<JointValue> out;
  const auto& motors = own.mechanism.motors();
  for (std::size_t j = 0; j < own.mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = own.mechanism.joints()[j];
    const bool has_column =
        !joint.closure || freedomsOf(joint.kind) == 1;  // a closing hinge or slide is a joint of the file
    if (!has_column || std::find(motors.begin(), motors.end(), j) != motors.end()) continue;
    const int parent = own.tree.element_of_body[joint.parent], child = own.tree.element_of_body[joint.child];
    const loops::PointMotion A = frames.pointOf(parent, joint.centre), B = frames.pointOf(child, joint.centre_of_child);
    const Matrix3d &R_A = frames.at(parent).R, &R_B = frames.at(child).R;
    const Vector3d w_r = B.omega - A.omega, alpha_r = B.alpha - A.alpha - A.omega.cross(w_r);
    const Vector3d r = B.x - A.x, v_r = B.v - A.v - A.omega.cross(r);
    const Vector3d a_r = B.a - A.a - A.alpha.cross(r) - A.omega.cross(A.omega.cross(r)) - 2 * A.omega.cross(v_r);
    const Matrix3d axes = own.mechanism.bodies()[joint.child].frame.linear();
    const auto in_tree = std::find_if(own.tree.elements.begin(), own.tree.elements.end(),
                                      [&](const loops::Element& each) { return each.joint == j; });
    if (joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic) {
      const Vector3d a = R_A * joint.axis[0];
      double q = a.dot(r);
      if (joint.kind == JointKind::revolute) {
        const Vector3d across = joint.axis[0].unitOrthogonal(), x = R_A * across,
                       y = R_B * (joint.turn.transpose() * across);
        q = std::atan2(a.dot(x.cross(y)), x.dot(y));
      }
      if (in_tree != own.tree.elements.end()) q = work.pose.q(in_tree->first);
      const bool slides = joint.slides();
      out.push_back({joint.name + (slides ? "_m" : "_rad"), joint.position + q, a.dot(slides ? v_r : w_r),
                     a.dot(slides ? a_r : alpha_r)});
    } else if (joint.kind == JointKind::ball) {
      const Matrix3d turn = R_A.transpose() * R_B * joint.turn.transpose();
      addQuaternion(joint.name, quaternionOf(turn, R_A.transpose() * w_r, R_A.transpose() * alpha_r, axes), out);
    } else if (joint.kind == JointKind::free) {
      const loops::PointMotion origin = frames.pointOf(child, own.mechanism.bodies()[joint.child].frame.translation());
      for (int k = 0; k < 3; ++k)
        out.push_back({fmt::format("{}_{}_m", joint.name, "xyz"[k]), origin.x(k), origin.v(k), origin.a(k)});
      QuaternionMotion turn = quaternionOf(R_B * axes, B.omega, B.alpha, Matrix3d::Identity());
      addQuaternion(joint.name, turn, out);
    } else if (joint.kind == JointKind::universal && in_tree != own.tree.elements.end()) {
      for (auto each = in_tree; each != own.tree.elements.end() && each->joint == j; ++each)
        out.push_back({fmt::format("{}_{}_rad", joint.name, each->axis_of_joint + 1), work.pose.q(each->first),
                       work.u(each->first), work.u_dot(each->first)});
    }
  }
  return out;
}

}  // namespace ursula
