#include "model/loops/simbody/simbody_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "model/loops/simbody/simbody_loop_internal.h"

namespace ursula {

SimbodyLoop::SimbodyLoop(const Manipulator& manipulator, Topology topology, std::shared_ptr<const Load> load)
    : impl_(std::make_unique<Impl>(manipulator, topology, std::move(load))) {}
SimbodyLoop::~SimbodyLoop() = default;
SimbodyLoop::SimbodyLoop(SimbodyLoop&&) noexcept = default;
SimbodyLoop& SimbodyLoop::operator=(SimbodyLoop&&) noexcept = default;

int SimbodyLoop::Impl::indexOf(int joint, int leg) const {
  const auto i = static_cast<std::size_t>(leg);
  return joint < 2 ? mechanism.proximal[i].getFirstUIndex(state) + joint
                   : int(mechanism.distal[i].getFirstUIndex(state));
}

void SimbodyLoop::Impl::setLeg(int leg, double phi, double psi, double theta) {
  const auto i = static_cast<std::size_t>(leg);
  mechanism.proximal[i].setOneQ(state, 0, phi);
  mechanism.proximal[i].setOneQ(state, 1, psi);
  mechanism.distal[i].setOneQ(state, 0, theta);
}

/// The plane of the leg holds u and B; in it the knee R is where the circles about A and B meet, on the side that
/// `knee` says: turning from RA to RB about x is positive for a positive knee.
std::array<double, 3> SimbodyLoop::Impl::legGeometry(int leg, const Motion<double>& motion) const {
  const Leg& from = parameters.leg(leg);
  const SimTK::Rotation& frame =
      mechanism.proximal[static_cast<std::size_t>(leg)].getInboardFrame(state).R();  // columns −u, x̂, ẑ
  const Vector3d u = -toEigen(SimTK::Vec3(frame.x()));
  const Vector3d d = motion.p + motion.Q * from.platform_point - from.base_point;
  const Vector3d off_axis = d - d.dot(u) * u;
  const Vector3d z = off_axis.normalized(), x = u.cross(z);
  const double l = from.proximal.length, s = from.distal.length;
  const double q2 = d.squaredNorm(), q = std::sqrt(q2);
  // Along d from A, and off it, in the plane of the leg.
  const double along = (l * l - s * s + q2) / (2 * q);
  const double off2 = (l - along) * (l + along);
  if (!(off2 >= 0) || !(off_axis.norm() > 0))
    throw std::domain_error(fmt::format(
        "leg {} cannot reach at t = {} s: the distance is {} m, its links {} m and {} m", leg + 1, motion.t, q, l, s));
  const double side = from.knee == Knee::positive ? 1 : -1;
  const Vector3d R = along * d / q + side * std::sqrt(off2) * x.cross(d / q);
  const Vector3d to_A = -R, to_B = d - R;
  const double phi = std::atan2(x.dot(toEigen(SimTK::Vec3(frame.z()))), x.dot(toEigen(SimTK::Vec3(frame.y()))));
  const double psi = std::atan2(R.dot(z), R.dot(u));
  const double theta = std::atan2(to_A.cross(to_B).dot(x), to_A.dot(to_B));
  return {phi, psi, theta};
}

void SimbodyLoop::Impl::setPlatformPose(const Motion<double>& motion) {
  const SimTK::Transform X_GB(toSimTK(motion.Q), toSimTK(motion.p));
  mechanism.platform.setQToFitTransform(state, SimTK::Transform());  // what was there may be no number
  realize(SimTK::Stage::Position);
  const SimTK::MobilizedBody& parent = mechanism.platform.getParentMobilizedBody();
  const SimTK::Transform X_GF = parent.getBodyTransform(state) * mechanism.platform.getInboardFrame(state);
  mechanism.platform.setQToFitTransform(state, ~X_GF * X_GB * mechanism.platform.getOutboardFrame(state));
}

Eigen::MatrixXd SimbodyLoop::Impl::constraintJacobian() const {
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
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(constraintsAndPlatform());
  const Eigen::Index n = factors.rows();
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

JointMotion SimbodyLoop::place(const Motion<double>& motion) {
  impl_->state.setTime(motion.t);
  for (int i = 0; i < leg_count; ++i) {
    const std::array<double, 3> q = impl_->legGeometry(i, motion);
    impl_->setLeg(i, q[0], q[1], q[2]);
  }
  impl_->setPlatformPose(motion);
  impl_->setRates(motion);
  return joints();
}

void SimbodyLoop::place(const Motion<double>& motion, const JointMotion& joint_motion) {
  Impl& loop = *impl_;
  loop.state.setTime(motion.t);
  for (int i = 0; i < leg_count; ++i)
    loop.setLeg(i, joint_motion.q.phi(i), joint_motion.q.psi(i), joint_motion.q.theta(i));
  loop.setPlatformPose(motion);
  loop.setRates(motion);  // the platform's; the legs' follow
  for (int i = 0; i < leg_count; ++i) {
    const auto set = [&](int joint, double rate, double acceleration) {
      loop.state.updU()[loop.indexOf(joint, i)] = rate;
      loop.u_dot[loop.indexOf(joint, i)] = acceleration;
    };
    set(0, joint_motion.q_dot.phi(i), joint_motion.q_ddot.phi(i));
    set(1, joint_motion.q_dot.psi(i), joint_motion.q_ddot.psi(i));
    set(2, joint_motion.q_dot.theta(i), joint_motion.q_ddot.theta(i));
  }
  loop.realize(SimTK::Stage::Velocity);
}

JointMotion SimbodyLoop::joints() const {
  const Impl& loop = *impl_;
  JointMotion out;
  for (int i = 0; i < leg_count; ++i) {
    const auto leg = static_cast<std::size_t>(i);
    out.q.phi(i) = loop.mechanism.proximal[leg].getOneQ(loop.state, 0);
    out.q.psi(i) = loop.mechanism.proximal[leg].getOneQ(loop.state, 1);
    out.q.theta(i) = loop.mechanism.distal[leg].getOneQ(loop.state, 0);
    out.q_dot.phi(i) = loop.mechanism.rate(loop.state, 0, i);
    out.q_dot.psi(i) = loop.mechanism.rate(loop.state, 1, i);
    out.q_dot.theta(i) = loop.mechanism.rate(loop.state, 2, i);
    out.q_ddot.phi(i) = loop.u_dot[loop.indexOf(0, i)];
    out.q_ddot.psi(i) = loop.u_dot[loop.indexOf(1, i)];
    out.q_ddot.theta(i) = loop.u_dot[loop.indexOf(2, i)];
  }
  return out;
}

}  // namespace ursula
