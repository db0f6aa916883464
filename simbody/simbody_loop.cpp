#include "simbody/simbody_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_loop_internal.h"

namespace ursula {

SimbodyLoop::SimbodyLoop(const Manipulator& manipulator, Topology topology, std::shared_ptr<const Load> load)
    : impl_(std::make_unique<Impl>(manipulator, topology, std::move(load))) {}
SimbodyLoop::~SimbodyLoop() = default;
SimbodyLoop::SimbodyLoop(SimbodyLoop&&) noexcept = default;
SimbodyLoop& SimbodyLoop::operator=(SimbodyLoop&&) noexcept = default;

int SimbodyLoop::Impl::indexOf(int joint, int leg) const {
  const LoopParts::Place place = mechanism.place(joint, leg);
  return place.body.getFirstUIndex(state) + place.coordinate;
}

void SimbodyLoop::Impl::setLeg(int leg, const std::array<double, 3>& q) {
  for (int joint = 0; joint < 3; ++joint) {
    const LoopParts::Place place = mechanism.place(joint, leg);
    place.body.setOneQ(state, place.coordinate, q[joint]);
  }
  for (const LoopParts::Rotor& rotor : mechanism.rotors)
    if (rotor.leg == leg) rotor.wheel.setOneQ(state, 0, q[rotor.joint]);
}

std::array<double, 3> SimbodyLoop::Impl::legGeometry(int leg, const Motion<double>& motion) const {
  const Leg& from = parameters.leg(leg);
  const Vector3d d = motion.p + motion.Q * from.platform_point - from.base_point;
  if (const auto q = ursula::legGeometry(from, fixedFrame(from.base_axis), d)) return *q;
  throw std::domain_error(
      fmt::format("leg {} ({}) cannot reach at t = {} s: the distance is {} m, its links {} m and {} m", leg + 1,
                  rowOf(from.kind).name, motion.t, d.norm(), from.proximal.length, from.distal.length));
}

void SimbodyLoop::Impl::setPlatformPose(const Motion<double>& motion) {
  const SimTK::Transform X_GB(toSimTK(motion.Q), toSimTK(motion.p));
  placed_jacobian.reset();
  if (topology == Topology::ball_per_leg) {  // the platform is on the ground
    mechanism.platform.setQToFitTransform(
        state, ~mechanism.platform.getDefaultInboardFrame() * X_GB * mechanism.platform.getDefaultOutboardFrame());
    return;
  }
  mechanism.platform.setQToFitTransform(state, SimTK::Transform());  // the previous state may be NaN
  realize(SimTK::Stage::Position);
  const SimTK::MobilizedBody& parent = mechanism.platform.getParentMobilizedBody();
  const SimTK::Transform X_GF = parent.getBodyTransform(state) * mechanism.platform.getInboardFrame(state);
  mechanism.platform.setQToFitTransform(state, ~X_GF * X_GB * mechanism.platform.getOutboardFrame(state));
}

// calcG takes a sweep of the tree for each coordinate. A ball joins one leg to the platform, so one sweep serves a
// joint of all legs, and every number has the bits of calcG's.
Eigen::MatrixXd SimbodyLoop::Impl::jacobianOfBalls() const {
  const int platform = mechanism.platform.getFirstUIndex(state);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * legCount(), state.getNU());
  SimTK::Vector bias, rates(state.getNU()), errors;
  matter.calcBiasForMultiplyByG(state, bias);
  for (int joint = 0; joint < 3; ++joint) {
    rates.setToZero();
    for (int leg = 0; leg < legCount(); ++leg) rates[indexOf(joint, leg)] = 1;
    matter.multiplyByG(state, rates, bias, errors);
    for (int leg = 0; leg < legCount(); ++leg)
      out.block<3, 1>(3 * leg, indexOf(joint, leg)) = mapped(errors).segment<3>(3 * leg);
  }
  for (int k = platform; k < platform + 6; ++k) {
    rates.setToZero();
    rates[k] = 1;
    matter.multiplyByG(state, rates, bias, errors);
    out.col(k) = mapped(errors);
  }
  return out;
}

Eigen::MatrixXd SimbodyLoop::Impl::constraintJacobian() const {
  if (topology == Topology::ball_per_leg && mechanism.rotors.empty()) return jacobianOfBalls();
  SimTK::Matrix G;
  matter.calcG(state, G);
  Eigen::MatrixXd out(G.nrow(), G.ncol());
  for (int i = 0; i < G.nrow(); ++i)
    for (int j = 0; j < G.ncol(); ++j) out(i, j) = G(i, j);
  return out;
}

Eigen::MatrixXd SimbodyLoop::Impl::constraintsAndPlatform() const {
  SimTK::Matrix J;
  matter.calcFrameJacobian(state, mechanism.platform.getMobilizedBodyIndex(), SimTK::Vec3(0), J);
  const Eigen::MatrixXd G = constraintJacobian();
  Eigen::MatrixXd out(G.rows() + 6, G.cols());
  out.topRows(G.rows()) = G;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < J.ncol(); ++j) out(G.rows() + i, j) = J(i, j);
  return out;
}

void SimbodyLoop::Impl::setRates(const Motion<double>& motion) {
  realize(SimTK::Stage::Position);
  const Eigen::MatrixXd constraints = constraintsAndPlatform();
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(constraints);
  const Eigen::Index n = factors.rows();
  placed_jacobian = constraints.topRows(n - 6);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  right.tail<6>() << motion.omega, motion.p_dot;
  const Eigen::VectorXd u = factors.solve(right);
  if (!u.allFinite())
    throw std::runtime_error(fmt::format("Simbody's constraints do not determine the rates at t = {} s", motion.t));
  for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = u(i);

  realize(SimTK::Stage::Velocity);
  SimTK::Vector bias;
  matter.calcBiasForAccelerationConstraints(state, bias);
  const SimTK::SpatialVec platform_bias =
      matter.calcBiasForFrameJacobian(state, mechanism.platform.getMobilizedBodyIndex(), SimTK::Vec3(0));
  right.head(n - 6) = -mapped(bias);
  right.tail<6>() << motion.omega_dot, motion.p_ddot;
  right.tail<6>() -= toEigen(platform_bias);
  const Eigen::VectorXd u_dot_found = factors.solve(right);
  for (int i = 0; i < state.getNU(); ++i) u_dot[i] = u_dot_found(i);
}

void SimbodyLoop::Impl::setFreePlatform(const Motion<double>& motion) {
  realize(SimTK::Stage::Position);
  const int first = mechanism.platform.getFirstUIndex(state);
  for (int k = 0; k < 3; ++k) {
    state.updU()[first + k] = motion.omega(k);
    state.updU()[first + 3 + k] = motion.p_dot(k);
    u_dot[first + k] = motion.omega_dot(k);
    u_dot[first + 3 + k] = motion.p_ddot(k);
  }
}

JointMotion SimbodyLoop::place(const Motion<double>& motion) {
  impl_->state.setTime(motion.t);
  for (int i = 0; i < impl_->legCount(); ++i) impl_->setLeg(i, impl_->legGeometry(i, motion));
  impl_->setPlatformPose(motion);
  impl_->setRates(motion);
  return joints();
}

void SimbodyLoop::place(const Motion<double>& motion, const JointMotion& joint_motion) {
  Impl& loop = *impl_;
  loop.state.setTime(motion.t);
  const auto coordinates = [&](int leg) { return rowOf(loop.parameters.leg(leg).kind).coordinates; };
  for (int i = 0; i < loop.legCount(); ++i) {
    std::array<double, 3> q{};
    for (std::size_t j = 0; j < 3; ++j) q[j] = joint_motion.q.of(coordinates(i)[j])(i);
    loop.setLeg(i, q);
  }
  loop.setPlatformPose(motion);
  // Six balls on wrong legs may not determine the rates; the free platform does not need them.
  loop.topology == Topology::tree_through_leg_1 ? loop.setRates(motion) : loop.setFreePlatform(motion);
  for (int i = 0; i < loop.legCount(); ++i)
    for (int joint = 0; joint < 3; ++joint) {
      const Coordinate coordinate = coordinates(i)[joint];
      loop.state.updU()[loop.indexOf(joint, i)] = joint_motion.q_dot.of(coordinate)(i);
      loop.u_dot[loop.indexOf(joint, i)] = joint_motion.q_ddot.of(coordinate)(i);
    }
  for (const LoopParts::Rotor& rotor : loop.mechanism.rotors) {
    loop.state.updU()[loop.indexOf(rotor)] = loop.state.getU()[loop.indexOf(rotor.joint, rotor.leg)];
    loop.u_dot[loop.indexOf(rotor)] = loop.u_dot[loop.indexOf(rotor.joint, rotor.leg)];
  }
  loop.realize(SimTK::Stage::Velocity);
}

JointMotion SimbodyLoop::joints() const {
  const Impl& loop = *impl_;
  JointMotion out;
  for (int i = 0; i < loop.legCount(); ++i)
    for (int joint = 0; joint < 3; ++joint) {
      const Coordinate coordinate = rowOf(loop.parameters.leg(i).kind).coordinates[joint];
      const LoopParts::Place place = loop.mechanism.place(joint, i);
      out.q.of(coordinate)(i) = place.body.getOneQ(loop.state, place.coordinate);
      out.q_dot.of(coordinate)(i) = loop.mechanism.rate(loop.state, joint, i);
      out.q_ddot.of(coordinate)(i) = loop.u_dot[loop.indexOf(joint, i)];
    }
  return out;
}

// The functions below call Simbody as a user does who has the joints' motion: with the fewest calls that suffice.
// Forces are summed here, because Simbody's own force subsystem would realize all stages up to Dynamics.

void SimbodyLoop::coordinates(const Motion<double>& motion, const JointMotion& joint_motion,
                              TreeCoordinates& out) const {
  const Impl& loop = *impl_;
  out.motion = motion;
  out.q.resize(loop.state.getNQ());
  out.u.resize(loop.state.getNU());
  out.u_dot.resize(out.u.size());
  for (int leg = 0; leg < loop.legCount(); ++leg)
    for (int joint = 0; joint < 3; ++joint) {
      const Coordinate coordinate = rowOf(loop.parameters.leg(leg).kind).coordinates[joint];
      const std::size_t at = loop.indexOf(joint, leg);  // q has the order of u before the platform's
      out.q[at] = joint_motion.q.of(coordinate)(leg);
      out.u[at] = joint_motion.q_dot.of(coordinate)(leg);
      out.u_dot[at] = joint_motion.q_ddot.of(coordinate)(leg);
    }
  for (const LoopParts::Rotor& rotor : loop.mechanism.rotors) {
    const std::size_t at = loop.indexOf(rotor), of = loop.indexOf(rotor.joint, rotor.leg);
    out.q[rotor.wheel.getFirstQIndex(loop.state)] = out.q[of];
    out.u[at] = out.u[of];
    out.u_dot[at] = out.u_dot[of];
  }
  const int first_q = loop.mechanism.platform.getFirstQIndex(loop.state);
  const int first_u = loop.mechanism.platform.getFirstUIndex(loop.state);
  const Eigen::Quaterniond Q(motion.Q);
  Eigen::Map<Eigen::Matrix<double, 7, 1>>(out.q.data() + first_q) << Q.w(), Q.vec(), motion.p;
  Eigen::Map<Vector6d>(out.u.data() + first_u) << motion.omega, motion.p_dot;
  Eigen::Map<Vector6d>(out.u_dot.data() + first_u) << motion.omega_dot, motion.p_ddot;
}

void SimbodyLoop::Impl::applyForces() {
  SimTK::Vector_<SimTK::SpatialVec>& on_bodies = scratch.body_forces;
  SimTK::Vector& on_joints = scratch.mobility_forces;
  on_bodies.resize(matter.getNumBodies());
  on_joints.resize(state.getNU());
  on_bodies.setToZero();
  on_joints.setToZero();
  const SimTK::Vec3 g = toSimTK(parameters.gravity());
  for (SimTK::MobilizedBodyIndex body(1); body < matter.getNumBodies(); ++body) {
    const SimTK::MobilizedBody& here = matter.getMobilizedBody(body);
    const SimTK::Vec3 weight = here.getBodyMass(state) * g;
    on_bodies[body] = {(here.getBodyRotation(state) * here.getBodyMassCenterStation(state)) % weight, weight};
  }
  for (int i = 0; i < legCount(); ++i) {
    const Leg& leg = parameters.leg(i);
    if (!leg.friction.any() && !leg.coulomb.any()) continue;
    for (int joint = 0; joint < 3; ++joint) {
      const double viscous = leg.friction.on(rowOf(leg.kind).coordinates[joint]);
      const double rate = mechanism.rate(state, joint, i);
      on_joints[indexOf(joint, i)] = coulombForce(leg, joint, rate) - viscous * rate;
    }
  }
  if (applied->load)
    on_bodies[mechanism.platform.getMobilizedBodyIndex()] += loadOnPlatform(*applied->load, mechanism, state);
}

void SimbodyLoop::openTree(const TreeCoordinates& at, OpenTree& out) {
  Impl& loop = *impl_;
  OpenTreeScratch& scratch = loop.scratch;
  loop.placed_jacobian.reset();
  loop.state.setTime(at.motion.t);
  std::copy(at.q.begin(), at.q.end(), &loop.state.updQ()[0]);
  std::copy(at.u.begin(), at.u.end(), &loop.state.updU()[0]);
  std::copy(at.u_dot.begin(), at.u_dot.end(), &loop.u_dot[0]);
  loop.realize(SimTK::Stage::Velocity);
  loop.applyForces();
  loop.matter.calcResidualForceIgnoringConstraints(loop.state, scratch.mobility_forces, scratch.body_forces, loop.u_dot,
                                                   scratch.residual);
  // This takes one sweep per constraint; calcG takes one per coordinate.
  loop.matter.calcGTranspose(loop.state, scratch.G_transposed);

  const auto force = mapped(scratch.residual);
  const auto G = Eigen::Map<const Eigen::MatrixXd>(scratch.G_transposed.getContiguousScalarData(),
                                                   scratch.G_transposed.nrow(), scratch.G_transposed.ncol())
                     .transpose();
  const int platform = loop.mechanism.platform.getFirstUIndex(loop.state);
  for (int i = 0; i < loop.legCount(); ++i) {
    OpenTree::Leg& leg = out.legs[i];
    const int first = loop.indexOf(0, i);
    leg.J = G.block<3, 3>(3 * i, first);
    leg.P = -G.block<3, 6>(3 * i, platform);
    leg.force = force.segment<3>(first);
  }
  for (const LoopParts::Rotor& rotor : loop.mechanism.rotors)
    out.legs[rotor.leg].force(rotor.joint) += force(loop.indexOf(rotor));
  out.force = force.segment<6>(platform);
}

Vector6d SimbodyLoop::twistRate(const TreeCoordinates& at, const Vector6d& efforts) {
  Impl& loop = *impl_;
  loop.placed_jacobian.reset();
  loop.state.setTime(at.motion.t);
  std::copy(at.q.begin(), at.q.end(), &loop.state.updQ()[0]);
  std::copy(at.u.begin(), at.u.end(), &loop.state.updU()[0]);
  accelerate(efforts);
  return mapped(loop.u_dot).segment<6>(loop.mechanism.platform.getFirstUIndex(loop.state));
}

std::string simbodyVersion() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

}  // namespace ursula
