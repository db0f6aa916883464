#include "parts/causes/mechanism_instants.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ursula::mechanisms {

PointState pointOf(const BodyState& body, const Vector3d& reference) {
  const Vector3d x = body.displacement * reference, r = x - body.center;
  const Vector3d w = body.twist.head<3>(), alpha = body.twist_rate.head<3>();
  return {x, body.twist.tail<3>() + w.cross(r), body.twist_rate.tail<3>() + alpha.cross(r) + w.cross(w.cross(r))};
}

namespace {

/// What both sides of a joint do, and the rates of each motor.
class JointSides {
 public:
  JointSides(const MechanismJoint& joint, const LoopWork& work)
      : parent_(work.bodies[joint.parent]),
        child_(work.bodies[joint.child]),
        R_A(parent_.displacement.linear()),
        at_(pointOf(child_, joint.centre_of_child)),
        T_A(work.T[joint.parent]),
        T_B(work.T[joint.child]) {
    const PointState A = pointOf(parent_, parent_.displacement.inverse() * at_.x);
    v_r = at_.v - A.v;
    a_r = at_.a - A.a - 2 * omega().cross(v_r);
  }

  Vector3d omega() const { return parent_.twist.head<3>(); }
  Vector3d turning() const { return child_.twist.head<3>() - omega(); }
  Vector3d turningRate() const { return child_.twist_rate.head<3>() - parent_.twist_rate.head<3>(); }
  MatrixXd turns() const { return T_B.topRows<3>() - T_A.topRows<3>(); }

  Coordinate about(const Vector3d& axis) const {
    Coordinate out = along(axis);
    out.slides = false;
    out.rate = axis.dot(turning());
    out.acceleration = axis.dot(turningRate()) + omega().cross(axis).dot(turning());
    out.row = axis.transpose() * turns();
    return out;
  }

  Coordinate along(const Vector3d& axis) const {
    Coordinate out;
    out.slides = true;
    out.axis = axis;
    out.point = at_.x;
    out.rate = axis.dot(v_r);
    out.acceleration = axis.dot(a_r);
    out.row.resize(T_A.cols());
    for (Eigen::Index k = 0; k < T_A.cols(); ++k) {
      const Vector3d on_child = columnAt(T_B, k, at_.x - child_.center);
      out.row(k) = axis.dot(on_child - columnAt(T_A, k, at_.x - parent_.center));
    }
    return out;
  }

  /// Both coordinates of a universal joint: w_r = a r_1 + b r_2, with a fixed in the parent and b in the child.
  std::vector<Coordinate> aboutBoth(const Vector3d& a, const Vector3d& b) const {
    Eigen::Matrix<double, 3, 2> axes;
    axes << a, b;
    const Eigen::Matrix<double, 2, 3> of = (axes.transpose() * axes).inverse() * axes.transpose();
    const Eigen::Vector2d rate = of * turning();
    const Vector3d rest = omega().cross(a) * rate(0) + Vector3d(child_.twist.head<3>()).cross(b) * rate(1);
    const Eigen::Vector2d acceleration = of * (turningRate() - rest);
    std::vector<Coordinate> out = {about(a), about(b)};
    for (int k = 0; k < 2; ++k) {
      out[k].rate = rate(k);
      out[k].acceleration = acceleration(k);
      out[k].row = of.row(k) * turns();
    }
    return out;
  }

 private:
  static Vector3d columnAt(const MatrixXd& T, Eigen::Index k, const Vector3d& r) {
    return Vector3d(T.block<3, 1>(3, k)) + Vector3d(T.block<3, 1>(0, k)).cross(r);
  }

  const BodyState &parent_, &child_;

 public:
  const Matrix3d R_A;

 private:
  PointState at_;
  const MatrixXd &T_A, &T_B;
  Vector3d v_r, a_r;
};

std::vector<Coordinate> coordinatesOf(const MechanismJoint& joint, const LoopWork& work) {
  const JointSides sides(joint, work);
  const Matrix3d& R = sides.R_A;
  std::vector<Coordinate> out;
  switch (joint.kind) {
    case JointKind::fixed:
      break;
    case JointKind::revolute:
      return {sides.about(R * joint.axis[0])};
    case JointKind::prismatic:
      return {sides.along(R * joint.axis[0])};
    case JointKind::universal:
      return sides.aboutBoth(R * joint.axis[0],
                             work.bodies[joint.child].displacement.linear() * (joint.turn.transpose() * joint.axis[1]));
    case JointKind::free:
      for (int k = 0; k < 3; ++k) out.push_back(sides.along(R.col(k)));
      [[fallthrough]];
    case JointKind::ball:
      for (int k = 0; k < 3; ++k) out.push_back(sides.about(R.col(k)));
      break;
  }
  return out;
}

}  // namespace

Vector6d Instant::biasOf(std::size_t body) const { return work.bodies[body].twist_rate - work.T[body] * motion.qddot; }

VectorXd loadsOf(const Mechanism& mechanism, const Instant& at) {
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(at.coordinates.size()));
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    const Coordinate& each = at.coordinates[c];
    const MechanismJoint& joint = mechanism.joints()[each.joint];
    double& force = out(static_cast<Eigen::Index>(c));
    force = joint.damping * each.rate + joint.rotor_inertia * each.acceleration +
            joint.stiffness * (each.value - joint.spring_reference);
    if (joint.friction != 0) force += joint.friction * std::tanh(each.rate / joint.smoothing());
  }
  return out;
}

Instant instantAt(const LoopMotion& motion, double t) {
  Instant out;
  const LoopSolver& solver = motion.solver();
  const Mechanism& mechanism = solver.mechanism();
  out.motion = motion.trajectory().at(t);
  loops::LoopPose pose = motion.near(t);
  solver.moveTo(out.motion.q, pose);
  solver.kinematics(out.motion, pose, out.work);
  const std::vector<LoopSolver::JointValue> values = solver.joints(out.work);
  for (std::size_t j = 0; j < mechanism.joints().size(); ++j) {
    const MechanismJoint& joint = mechanism.joints()[j];
    for (Coordinate& each : coordinatesOf(joint, out.work)) {
      each.joint = j;
      for (const LoopSolver::JointValue& value : values)
        if (value.name == joint.name + (each.slides ? "_m" : "_rad")) each.value = value.value;
      for (std::size_t k = 0; k < mechanism.motorCount(); ++k)
        if (mechanism.motors()[k] == j) each.value = out.motion.q(static_cast<Eigen::Index>(k));
      out.coordinates.push_back(each);
    }
  }
  return out;
}

FileTree::FileTree(const Mechanism& mechanism)
    : mechanism_(&mechanism), sign_(mechanism.joints().size(), 0), path_to_(mechanism.bodies().size()) {
  std::vector<char> placed(mechanism.bodies().size(), 0);
  for (std::size_t b = 0; b < placed.size(); ++b) placed[b] = mechanism.bodies()[b].fixed ? 1 : 0;
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t j = 0; j < sign_.size(); ++j) {
      const MechanismJoint& joint = mechanism.joints()[j];
      if (joint.closure || placed[joint.parent] == placed[joint.child]) continue;
      const bool reversed = placed[joint.child] != 0;
      const std::size_t from = reversed ? joint.child : joint.parent, to = reversed ? joint.parent : joint.child;
      sign_[j] = reversed ? -1 : 1;
      path_to_[to] = path_to_[from];
      path_to_[to].push_back(j);
      placed[to] = 1;
      grown = true;
    }
  }
  whole_ = std::all_of(placed.begin(), placed.end(), [](char one) { return one != 0; }) &&
           std::all_of(mechanism.motors().begin(), mechanism.motors().end(), [&](std::size_t j) { return holds(j); });
}

bool FileTree::isBefore(std::size_t joint, std::size_t body) const {
  return std::find(path_to_[body].begin(), path_to_[body].end(), joint) != path_to_[body].end();
}

MatrixXd FileTree::jacobian(const Instant& at, std::size_t body, const Vector3d& point) const {
  MatrixXd out = MatrixXd::Zero(6, static_cast<Eigen::Index>(at.coordinates.size()));
  for (std::size_t c = 0; c < at.coordinates.size(); ++c) {
    const Coordinate& each = at.coordinates[c];
    if (!isBefore(each.joint, body)) continue;
    const auto column = static_cast<Eigen::Index>(c);
    const Vector3d axis = sign_[each.joint] * each.axis;
    if (each.slides)
      out.block<3, 1>(3, column) = axis;
    else
      out.col(column) << axis, axis.cross(point - each.point);
  }
  return out;
}

MatrixXd FileTree::jacobian(const Instant& at, std::size_t body) const {
  return jacobian(at, body, at.work.bodies[body].center);
}

VectorXd FileTree::accelerations(const Instant& at) const {
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(at.coordinates.size()));
  for (std::size_t c = 0; c < at.coordinates.size(); ++c)
    if (holds(at.coordinates[c].joint)) out(static_cast<Eigen::Index>(c)) = at.coordinates[c].acceleration;
  return out;
}

VectorXd FileTree::bias(const Instant& at) const {
  VectorXd out = accelerations(at);
  for (std::size_t c = 0; c < at.coordinates.size(); ++c)
    if (holds(at.coordinates[c].joint)) out(static_cast<Eigen::Index>(c)) -= at.coordinates[c].row.dot(at.motion.qddot);
  return out;
}

}  // namespace ursula::mechanisms
