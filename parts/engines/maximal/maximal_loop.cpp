#include "parts/engines/maximal/maximal_loop.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ursula {
namespace {

using maximal::Joint, maximal::PlacedLeg, maximal::base_body;
using Bodies = std::vector<BodyMotion<double>>;

constexpr int rows_per_leg = 12, rows_of_ball = 3;

const BodyMotion<double>& bodyOf(const Bodies& bodies, int body) {
  static const BodyMotion<double> base;
  return body == base_body ? base : bodies[body];
}

Vector3d omegaOf(const BodyMotion<double>& body) { return body.twist.head<3>(); }

/// Returns the velocity of the body-fixed point that is now at `point`.
Vector3d velocity(const BodyMotion<double>& body, const Vector3d& point) {
  return body.twist.tail<3>() + omegaOf(body).cross(point - body.c);
}

Vector3d centripetal(const BodyMotion<double>& body, const Vector3d& point) {
  return omegaOf(body).cross(omegaOf(body).cross(point - body.c));
}

/// Returns the rows that give the velocity of a body's point from its twist: v = ċ + ω × arm.
Eigen::Matrix<double, 3, 6> pointRows(const BodyMotion<double>& body, const Vector3d& point) {
  const Vector3d arm = point - body.c;
  Eigen::Matrix<double, 3, 6> rows;
  rows << 0, arm.z(), -arm.y(), 1, 0, 0, -arm.z(), 0, arm.x(), 0, 1, 0, arm.y(), -arm.x(), 0, 0, 0, 1;
  return rows;
}

/// Adds the rows of a point that two bodies share: v_parent − v_child = 0.
void addPoint(const Bodies& bodies, int parent, int child, const Vector3d& point, int row, Eigen::MatrixXd& G) {
  if (parent != base_body) G.block<3, 6>(row, 6 * parent) = pointRows(bodies[parent], point);
  G.block<3, 6>(row, 6 * child) = -pointRows(bodies[child], point);
}

/// Adds the row that forbids relative rotation about `normal`: (ω_child − ω_parent) · n = 0.
void addNormal(const Joint& joint, const Vector3d& normal, int row, Eigen::MatrixXd& G) {
  if (joint.parent != base_body) G.block<1, 3>(row, 6 * joint.parent) = -normal.transpose();
  G.block<1, 3>(row, 6 * joint.child) = normal.transpose();
}

/// Adds the rows that keep the child's point on a line fixed in the parent.
void addSlide(const Bodies& bodies, const Joint& joint, int row, Eigen::MatrixXd& G) {
  for (int k = 0; k < 3; ++k) addNormal(joint, Vector3d::Unit(k), row + k, G);
  const Eigen::Matrix<double, 2, 3> across = joint.across.transpose();
  if (joint.parent != base_body)
    G.block<2, 6>(row + 3, 6 * joint.parent) = across * pointRows(bodies[joint.parent], joint.point);
  G.block<2, 6>(row + 3, 6 * joint.child) = -across * pointRows(bodies[joint.child], joint.point);
}

void addJoint(const Bodies& bodies, const Joint& joint, int row, Eigen::MatrixXd& G) {
  if (joint.type == Joint::Type::prismatic) return addSlide(bodies, joint, row, G);
  addPoint(bodies, joint.parent, joint.child, joint.point, row, G);
  if (joint.type == Joint::Type::universal) return addNormal(joint, joint.axes[0].cross(joint.axes[1]), row + 3, G);
  for (int k = 0; k < 2; ++k) addNormal(joint, joint.across.col(k), row + 3 + k, G);
}

/// Returns the joint's part of γ: with rows n, n · ṫ = −ṅ · t.
Eigen::VectorXd gammaOf(const Bodies& bodies, const Joint& joint) {
  const BodyMotion<double>&parent = bodyOf(bodies, joint.parent), &child = bodyOf(bodies, joint.child);
  const Vector3d omega = omegaOf(parent), relative = omegaOf(child) - omega;
  const Vector3d apart = centripetal(child, joint.point) - centripetal(parent, joint.point);
  Eigen::VectorXd gamma = Eigen::VectorXd::Zero(joint.rows());
  if (joint.type == Joint::Type::prismatic) {
    const Vector3d& axis = joint.axes[0];
    const double rate = axis.dot(velocity(child, joint.point) - velocity(parent, joint.point));
    gamma.tail<2>() = joint.across.transpose() * (apart - 2 * rate * omega.cross(axis));  // Coriolis
    return gamma;
  }
  gamma.head<3>() = apart;
  if (joint.type == Joint::Type::universal)
    gamma(3) = -relative.dot(omega.cross(joint.axes[0]).cross(joint.axes[1]) +
                             joint.axes[0].cross(omegaOf(child).cross(joint.axes[1])));
  else
    for (int k = 0; k < 2; ++k) gamma(3 + k) = -relative.dot(omega.cross(Vector3d(joint.across.col(k))));
  return gamma;
}

/// Adds a moment about, or a force along, the joint's k-th axis to the child, and its reaction to the parent.
void addForce(const Bodies& bodies, const Joint& joint, int k, double size, Eigen::Ref<Eigen::VectorXd> wrenches) {
  const Vector3d given = size * joint.axes[k];
  const auto on = [&](int body) {
    Vector6d wrench;
    if (joint.type == Joint::Type::prismatic)
      wrench << (joint.point - bodies[body].c).cross(given), given;
    else
      wrench << given, Vector3d::Zero();
    return wrench;
  };
  wrenches.segment<6>(6 * joint.child) += on(joint.child);
  if (joint.parent != base_body) wrenches.segment<6>(6 * joint.parent) -= on(joint.parent);
}

/// Returns the joint of the leg's j-th coordinate, and the index of its axis.
std::pair<int, int> jointAndAxis(const PlacedLeg& leg, int j) {
  const int first = leg.joints[0].coordinates();
  return j < first ? std::pair{0, j} : std::pair{1, j - first};
}

/// Returns viscous and smoothed Coulomb friction against a joint's rate.
double friction(double viscous, double coulomb, double speed, double rate) {
  return -viscous * rate - coulomb * std::tanh(rate / speed);
}

}  // namespace

MaximalLoop::MaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load)
    : manipulator_(manipulator),
      load_(std::move(load)),
      bodies_(2 * manipulator.legCount() + 1),
      legs_(manipulator.legCount()) {}

MaximalLoop::~MaximalLoop() = default;

int MaximalLoop::constraints() const { return rows_per_leg * manipulator_.legCount(); }

int MaximalLoop::coordinates() const { return 6 * static_cast<int>(bodies_.size()); }

BodyMotions<double> MaximalLoop::bodies() const {
  const int legs = manipulator_.legCount();
  BodyMotions<double> out;
  std::copy_n(bodies_.begin(), legs, out.begin());
  std::copy_n(bodies_.begin() + legs, legs, out.begin() + leg_count);
  out.back() = bodies_.back();
  return out;
}

void MaximalLoop::place(const Motion<double>& motion) {
  const int legs = manipulator_.legCount();
  bodies_.back().R = motion.Q;
  bodies_.back().c = motion.p + motion.Q * manipulator_.platform().center_of_mass;
  for (int i = 0; i < legs; ++i) {
    PlacedLeg& leg = legs_[i];
    leg = maximal::placeLeg(manipulator_.leg(i), i, i, legs + i, motion);
    for (int k = 0; k < 2; ++k) {
      bodies_[k * legs + i].R = leg.R[k];
      bodies_[k * legs + i].c = leg.c[k];
    }
  }
}

/// Computes the links' twists and their rates from the constraints and the platform's twist and its rate.
void MaximalLoop::solveMotion(const Motion<double>& motion, bool with_gamma) {
  const int legs = manipulator_.legCount(), platform = 2 * legs;
  G_.setZero(constraints(), coordinates());
  gamma_.setZero(constraints());
  for (int i = 0; i < legs; ++i) {
    const PlacedLeg& leg = legs_[i];
    const int row = rows_per_leg * i, ball = row + rows_per_leg - rows_of_ball;
    addJoint(bodies_, leg.joints[0], row, G_);
    addJoint(bodies_, leg.joints[1], row + leg.joints[0].rows(), G_);
    addPoint(bodies_, legs + i, platform, leg.B, ball, G_);
  }
  MatrixX with_platform(coordinates(), coordinates());
  with_platform.topRows(constraints()) = G_;
  with_platform.bottomRows<6>().setZero();
  with_platform.bottomRightCorner<6, 6>().setIdentity();
  const Eigen::PartialPivLU<MatrixX> factors(with_platform);

  const Vector3d arm = bodies_.back().c - motion.p;
  VectorX right = VectorX::Zero(coordinates());
  right.tail<6>() << motion.omega, motion.p_dot + motion.omega.cross(arm);
  const VectorX t = factors.solve(right);
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b].twist = t.segment<6>(6 * static_cast<int>(b));

  for (int i = 0; i < legs; ++i) {
    const PlacedLeg& leg = legs_[i];
    gamma_.segment<rows_per_leg>(rows_per_leg * i) << gammaOf(bodies_, leg.joints[0]), gammaOf(bodies_, leg.joints[1]),
        centripetal(bodies_.back(), leg.B) - centripetal(bodies_[legs + i], leg.B);
  }
  if (!with_gamma) gamma_.setZero();
  right.head(constraints()) = gamma_;
  right.tail<6>() << motion.omega_dot,
      motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm));
  const VectorX t_rate = factors.solve(right);
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b].twist_rate = t_rate.segment<6>(6 * static_cast<int>(b));
}

/// Returns the friction on the leg's three coordinates.
Vector3d MaximalLoop::frictionOf(int index) const {
  const Leg& leg = manipulator_.leg(index);
  Vector3d out;
  for (int j = 0; j < 3; ++j) {
    const auto [which, k] = jointAndAxis(legs_[index], j);
    const Joint& joint = legs_[index].joints[which];
    const BodyMotion<double>&parent = bodyOf(bodies_, joint.parent), &child = bodyOf(bodies_, joint.child);
    const Vector3d relative = joint.type == Joint::Type::prismatic
                                  ? velocity(child, joint.point) - velocity(parent, joint.point)
                                  : omegaOf(child) - omegaOf(parent);
    const Coordinate coordinate = rowOf(leg.kind).coordinates[j];
    out(j) = friction(leg.friction.on(coordinate), leg.coulomb.on(coordinate), leg.coulomb.speedOf(coordinate),
                      relative.dot(joint.axes[k]));
  }
  return out;
}

void MaximalLoop::subtractFriction(int index, VectorX& w) const {
  const PlacedLeg& leg = legs_[index];
  const Vector3d on = frictionOf(index);
  VectorX given = VectorX::Zero(coordinates());
  if (leg.joints[1].type == Joint::Type::revolute) {  // ψ and θ turn about one axis
    addForce(bodies_, leg.joints[0], 0, on(0), given);
    addForce(bodies_, leg.joints[0], 1, on(1) - on(2), given);
    given.segment<3>(6 * leg.joints[1].child) = on(2) * leg.joints[1].axes[0];
  } else {
    for (int j = 0; j < 3; ++j) {
      const auto [which, k] = jointAndAxis(leg, j);
      addForce(bodies_, leg.joints[which], k, on(j), given);
    }
  }
  w -= given;
}

/// Returns inertia minus gravity, friction and load, which constraints and motors must balance.
MaximalLoop::VectorX MaximalLoop::unbalanced(const Motion<double>& motion) const {
  VectorX w(coordinates());
  const ManipulatorParameters& machine = manipulator_.parameters();
  const int legs = manipulator_.legCount(), platform = 2 * legs;
  for (int b = 0; b <= platform; ++b) {
    const Leg& leg = machine.legs[b % legs];
    const Link& link = b < legs ? leg.proximal : leg.distal;
    const double mass = b == platform ? machine.platform.mass : link.mass;
    const BodyMotion<double>& body = bodies_[b];
    const Matrix3d I = body.R * (b == platform ? machine.platform.inertia : link.inertia) * body.R.transpose();
    const Vector3d omega = omegaOf(body);
    w.segment<6>(6 * b) << I * body.twist_rate.head<3>() + omega.cross(I * omega),
        mass * (body.twist_rate.tail<3>() - machine.gravity);
  }
  for (int i = 0; i < legs; ++i) subtractFriction(i, w);
  if (load_) {
    const Wrench<double> load = load_->at(motion.t);
    const Matrix3d to_base = load_->frame == Load::Frame::platform ? motion.Q : Matrix3d(Matrix3d::Identity());
    const Vector3d force = to_base * load.force;
    const Vector3d arm = motion.Q * (load_->point - machine.platform.center_of_mass);
    w.tail<6>() -= (Vector6d() << to_base * load.moment + arm.cross(force), force).finished();
  }
  return w;
}

/// Returns q̈ of a motor's coordinate from its bodies: the rate of (ω_child − ω_parent) · axis, or of the velocity
/// along the slide. Along the slide, Coriolis acceleration and the parent's rotation have no part.
double MaximalLoop::accelerationOf(const Motor& motor) const {
  const PlacedLeg& leg = legs_[motor.leg];
  const auto [which, k] = jointAndAxis(leg, motor.joint);
  const Joint& joint = leg.joints[which];
  const BodyMotion<double>&parent = bodyOf(bodies_, joint.parent), &child = bodyOf(bodies_, joint.child);
  const Vector3d& axis = joint.axes[k];
  if (joint.type == Joint::Type::prismatic) {
    const auto acceleration = [&](const BodyMotion<double>& body) {
      return Vector3d(body.twist_rate.tail<3>() + body.twist_rate.head<3>().cross(joint.point - body.c) +
                      centripetal(body, joint.point));
    };
    return axis.dot(acceleration(child) - acceleration(parent));
  }
  const Vector3d carrier = omegaOf(k == 0 ? parent : child), relative = omegaOf(child) - omegaOf(parent);
  return axis.dot(child.twist_rate.head<3>() - parent.twist_rate.head<3>()) + relative.dot(carrier.cross(axis));
}

/// Adds the wrenches of a unit effort of one motor.
void MaximalLoop::addEffort(const Motor& motor, Eigen::Ref<VectorX> wrenches) const {
  const PlacedLeg& leg = legs_[motor.leg];
  const auto [which, k] = jointAndAxis(leg, motor.joint);
  addForce(bodies_, leg.joints[which], k, 1, wrenches);
}

Vector6d MaximalLoop::inverseDynamics(const Motion<double>& motion) {
  place(motion);
  solveMotion(motion);
  return balance(motion);
}

Vector6d MaximalLoop::balance(const Motion<double>& motion) const {
  // Gᵀλ + Sτ balances the rest; S applies each effort to the two bodies of its joint.
  MatrixX multipliers_and_efforts = MatrixX::Zero(coordinates(), coordinates());
  multipliers_and_efforts.leftCols(constraints()) = G_.transpose();
  for (int m = 0; m < motor_count; ++m)
    addEffort(manipulator_.motors()[m], multipliers_and_efforts.col(constraints() + m));
  const VectorX solution = multipliers_and_efforts.partialPivLu().solve(unbalanced(motion));
  Vector6d efforts = solution.tail<6>();
  for (int m = 0; m < motor_count; ++m) {  // j q̈ of the rotor
    const Motor& motor = manipulator_.motors()[m];
    const double rotor = manipulator_.leg(motor.leg).rotor_inertia.on(motor.coordinate);
    if (rotor != 0) efforts(m) += rotor * accelerationOf(motor);
  }
  return efforts;
}

std::unique_ptr<Engine> makeMaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<MaximalLoop>(manipulator, std::move(load));
}

}  // namespace ursula
