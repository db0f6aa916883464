// Open trees have joints q_L and a free platform q_P. The loops are closed if the points Bᵢ of distal link and platform
// coincide; G = [G_L G_P] is the Jacobian of the gaps.
//
//   G_L q̇_L = −G_P q̇_P                                                                                         (1)
//   G_L q̈_L = −(the gaps' acceleration for q̈_L = 0)                                                            (2)
//   Gᵀλ + Sτ = M q̈ + bias − friction − load, where S selects the driven coordinates                             (3)
//
// MuJoCo gives G, the accelerations in (2) and M q̈ + bias; its constraints, contacts and integrators are unused.

#include "parts/engines/mujoco/mujoco_loop.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "parts/engines/leg_motion.h"
#include "parts/engines/mujoco/mujoco_loop_internal.h"

namespace ursula {
namespace {

using mujoco::dofOf, mujoco::siteOnLeg, mujoco::siteOnPlatform;

using mujoco::GapJacobian, mujoco::VectorOfGaps, mujoco::VectorOfDofs;
using mujoco::most_dofs, mujoco::most_gaps;
using SquareOfGaps = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_gaps, most_gaps>;
using SquareOfDofs = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_dofs, most_dofs>;

Vector3d centroidOfBase(const Manipulator& manipulator) {
  Vector3d sum = Vector3d::Zero();
  for (const Leg& leg : manipulator.parameters().legs) sum += leg.base_point;
  return sum / manipulator.legCount();
}

}  // namespace

MujocoLoop::Impl::Impl(const Manipulator& from, std::shared_ptr<const Load> on_platform)
    : manipulator(from),
      load(std::move(on_platform)),
      legs(from.legCount()),
      leg_dofs(mujoco::legDofs(legs)),
      dofs(mujoco::dofsOf(legs)),
      origin(centroidOfBase(from)),
      model(mujoco::buildModel(from, origin)),
      data(mujoco::dataOf(*model)),
      G(leg_dofs, dofs) {
  for (int leg = 0; leg < legs; ++leg) offset_of_phi[leg] = mujoco::offsetOfPhi(manipulator.leg(leg));
}

void MujocoLoop::Impl::place(const Motion<double>& motion) {
  for (int leg = 0; leg < legs; ++leg)
    Eigen::Map<Vector3d>(data->qpos + dofOf(leg, 0)) =
        legCoordinates(manipulator.leg(leg), leg, mujoco::frameOf(manipulator.leg(leg)), motion);
  const Eigen::Quaterniond Q(motion.Q);
  Eigen::Map<Vector3d>(data->qpos + leg_dofs) = (motion.p - origin) + motion.Q * manipulator.platform().center_of_mass;
  Eigen::Map<Eigen::Vector4d>(data->qpos + leg_dofs + 3) << Q.w(), Q.x(), Q.y(), Q.z();
  mj_kinematics(model.get(), data.get());
  mj_comPos(model.get(), data.get());
  G = gapJacobian();
}

/// MuJoCo's free joint has linear speeds in the world frame and angular speeds in the body frame.
void MujocoLoop::Impl::move(const Motion<double>& motion) {
  const Vector3d arm = motion.Q * manipulator.platform().center_of_mass;
  Eigen::Map<VectorOfDofs> rates(data->qvel, dofs), accelerations(data->qacc, dofs);
  const Eigen::PartialPivLU<SquareOfGaps> factors(G.leftCols(leg_dofs));

  rates.tail<6>() << motion.p_dot + motion.omega.cross(arm), motion.Q.transpose() * motion.omega;
  rates.head(leg_dofs) = -factors.solve(G.rightCols<6>() * rates.tail<6>());  // (1)
  mj_comVel(model.get(), data.get());

  accelerations.head(leg_dofs).setZero();
  accelerations.tail<6>() << motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm)),
      motion.Q.transpose() * motion.omega_dot;
  mj_rnePostConstraint(model.get(), data.get());
  accelerations.head(leg_dofs) = -factors.solve(gapAcceleration());  // (2)
}

GapJacobian MujocoLoop::Impl::gapJacobian() const {
  using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor, 3, most_dofs>;
  GapJacobian jacobian(leg_dofs, dofs);
  PointJacobian on_leg(3, dofs), on_platform(3, dofs);
  for (int leg = 0; leg < legs; ++leg) {
    mj_jacSite(model.get(), data.get(), on_leg.data(), nullptr, siteOnLeg(leg));
    mj_jacSite(model.get(), data.get(), on_platform.data(), nullptr, siteOnPlatform(legs, leg));
    jacobian.middleRows<3>(3 * leg) = on_leg - on_platform;
  }
  return jacobian;
}

/// MuJoCo's accelerations include gravity, which cancels here.
VectorOfGaps MujocoLoop::Impl::gapAcceleration() const {
  const auto linear = [&](int site) {
    Vector6d angular_and_linear;
    mj_objectAcceleration(model.get(), data.get(), mjOBJ_SITE, site, angular_and_linear.data(), 0);
    return Vector3d(angular_and_linear.tail<3>());
  };
  VectorOfGaps gaps(leg_dofs);
  for (int leg = 0; leg < legs; ++leg)
    gaps.segment<3>(3 * leg) = linear(siteOnLeg(leg)) - linear(siteOnPlatform(legs, leg));
  return gaps;
}

/// The right-hand side of (3).
VectorOfDofs MujocoLoop::Impl::unbalanced(const Motion<double>& motion) const {
  return forcesOfTree() - given(*model, *data, motion);
}

/// Adds the rotors, which mj_rne omits because they belong to no body.
VectorOfDofs MujocoLoop::Impl::forcesOfTree() const {
  VectorOfDofs forces(dofs);
  mj_rne(model.get(), data.get(), 1, forces.data());
  for (int k = 0; k < leg_dofs; ++k)
    if (model->dof_armature[k] != 0) forces(k) += model->dof_armature[k] * data->qacc[k];
  return forces;
}

VectorOfDofs MujocoLoop::Impl::given(const mjModel& in_model, mjData& in_data, const Motion<double>& motion) const {
  VectorOfDofs forces = VectorOfDofs::Zero(dofs);
  for (int leg = 0; leg < legs; ++leg)
    forces.segment<3>(dofOf(leg, 0)) =
        frictionOn(manipulator.leg(leg), Eigen::Map<const Vector3d>(in_data.qvel + dofOf(leg, 0)));
  if (load) {
    const Wrench<double> wrench = load->at(motion.t);
    const bool in_platform = load->frame == Load::Frame::platform;
    const Vector3d force = in_platform ? motion.Q * wrench.force : wrench.force;
    const Vector3d moment = in_platform ? motion.Q * wrench.moment : wrench.moment;
    const Vector3d point = (motion.p - origin) + motion.Q * load->point;
    mj_applyFT(&in_model, &in_data, force.data(), moment.data(), point.data(), mujoco::platformBody(legs),
               forces.data());
  }
  return forces;
}

MujocoLoop::MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load)
    : impl_(std::make_unique<Impl>(manipulator, std::move(load))) {}

MujocoLoop::~MujocoLoop() = default;

Vector6d MujocoLoop::inverseDynamics(const Motion<double>& motion) {
  impl_->place(motion);
  impl_->move(motion);
  const int dofs = impl_->dofs, leg_dofs = impl_->leg_dofs;
  SquareOfDofs multipliers_and_efforts = SquareOfDofs::Zero(dofs, dofs);
  multipliers_and_efforts.leftCols(leg_dofs) = impl_->G.transpose();
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = impl_->manipulator.motors()[m];
    multipliers_and_efforts(dofOf(motor.leg, motor.joint), leg_dofs + m) = 1;
  }
  const Eigen::PartialPivLU<SquareOfDofs> factors(multipliers_and_efforts);
  return factors.solve(impl_->unbalanced(motion)).tail<6>();  // (3)
}

/// Returns φ at MuJoCo's zero, rad. It differs from 0 if the leg has a universal joint at the base.
double mujoco::offsetOfPhi(const Leg& leg) {
  if (rowOf(leg.kind).joints_of_proximal != 2) return 0;
  const Vector3d u = leg.base_axis.normalized(), level = u.cross(Vector3d::UnitZ());
  const Vector3d x = level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()) : level;
  const Matrix3d frame = mujoco::frameOf(leg);
  return std::atan2(-x.dot(u.cross(frame.col(0))), x.dot(frame.col(0)));
}

void MujocoLoop::Impl::readMaps(const mjModel& in_model, mjData& in_data, OpenTree& out) const {
  using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor, 3, most_dofs>;
  PointJacobian jacobian(3, dofs);
  for (int i = 0; i < legs; ++i) {
    OpenTree::Leg& leg = out.legs[i];
    mj_jacSite(&in_model, &in_data, jacobian.data(), nullptr, siteOnLeg(i));
    leg.J = jacobian.middleCols<3>(dofOf(i, 0));
    mj_jacSite(&in_model, &in_data, jacobian.data(), nullptr, siteOnPlatform(legs, i));
    leg.P = jacobian.rightCols<6>();
  }
}

void MujocoLoop::Impl::readTree(const Motion<double>& motion, const mujoco::VectorOfDofs& forces, OpenTree& out) {
  const mujoco::VectorOfDofs residual = forces - given(*model, *data, motion);
  readMaps(*model, *data, out);
  for (int i = 0; i < legs; ++i) out.legs[i].force = residual.segment<3>(dofOf(i, 0));
  out.force = residual.tail<6>();
}

bool mujocoAvailable() { return true; }

std::string mujocoVersion() { return mj_versionString(); }

std::unique_ptr<Engine> makeMujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load) {
  return std::make_unique<MujocoLoop>(manipulator, std::move(load));
}

}  // namespace ursula
