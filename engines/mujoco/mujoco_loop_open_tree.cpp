// Uses the fewest calls of MuJoCo that suffice, without its constraints, contacts and integrator.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engines/mujoco/mujoco_loop_internal.h"

namespace ursula {

using mujoco::dofOf, mujoco::most_dofs, mujoco::siteOnLeg, mujoco::siteOnPlatform;

/// With a universal joint at the base, MuJoCo's zero is another angle about −u.
double mujoco::offsetOfPhi(const Leg& leg) {
  if (rowOf(leg.kind).joints_of_proximal != 2) return 0;
  const Vector3d u = leg.base_axis.normalized(), level = u.cross(Vector3d::UnitZ());
  const Vector3d x = level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()) : level;
  const Matrix3d frame = mujoco::frameOf(leg);
  return std::atan2(-x.dot(u.cross(frame.col(0))), x.dot(frame.col(0)));
}

void MujocoLoop::coordinates(const Motion<double>& motion, const JointMotion& joint_motion,
                             TreeCoordinates& out) const {
  const Impl& loop = *impl_;
  out.motion = motion;
  out.q.resize(static_cast<std::size_t>(loop.dofs + 1));
  out.u.resize(static_cast<std::size_t>(loop.dofs));
  out.u_dot.resize(out.u.size());
  for (int leg = 0; leg < loop.legs; ++leg) {
    for (int joint = 0; joint < mujoco::joints_per_leg; ++joint) {
      const auto at = static_cast<std::size_t>(dofOf(leg, joint));
      const Leg& from = loop.manipulator.leg(leg);
      const Coordinate coordinate = rowOf(from.kind).coordinates[static_cast<std::size_t>(joint)];
      out.q[at] =
          joint_motion.q.of(coordinate)(leg) + (joint == 0 ? loop.offset_of_phi[static_cast<std::size_t>(leg)] : 0);
      out.u[at] = joint_motion.q_dot.of(coordinate)(leg);
      out.u_dot[at] = joint_motion.q_ddot.of(coordinate)(leg);
    }
  }
  const Vector3d arm = motion.Q * loop.manipulator.platform().center_of_mass, v = motion.omega.cross(arm);
  const Eigen::Quaterniond Q(motion.Q);
  Eigen::Map<Eigen::Matrix<double, 7, 1>>(out.q.data() + loop.leg_dofs) << (motion.p - loop.origin) + arm, Q.w(),
      Q.vec();
  Eigen::Map<Vector6d>(out.u.data() + loop.leg_dofs) << motion.p_dot + v, motion.Q.transpose() * motion.omega;
  Eigen::Map<Vector6d>(out.u_dot.data() + loop.leg_dofs)
      << motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(v),
      motion.Q.transpose() * motion.omega_dot;
}

Vector6d MujocoLoop::Impl::twistRate(const Motion<double>& motion, const Vector6d& rates_of_speeds) const {
  const Vector3d arm = motion.Q * manipulator.platform().center_of_mass;
  Vector6d out;
  out.head<3>() = motion.Q * rates_of_speeds.tail<3>();
  out.tail<3>() = rates_of_speeds.head<3>() - out.head<3>().cross(arm) - motion.omega.cross(motion.omega.cross(arm));
  return out;
}

Vector6d MujocoLoop::twistRate(const TreeCoordinates& at, const Vector6d& rates_of_speeds) const {
  return impl_->twistRate(at.motion, rates_of_speeds);
}

void MujocoLoop::Impl::placeTree(const TreeCoordinates& at) {
  std::copy(at.q.begin(), at.q.end(), data->qpos);
  std::copy(at.u.begin(), at.u.end(), data->qvel);
  mj_kinematics(model.get(), data.get());
  mj_comPos(model.get(), data.get());
  mj_comVel(model.get(), data.get());
}

void MujocoLoop::Impl::readMaps(const mjModel& in_model, mjData& in_data, OpenTree& out) const {
  using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor, 3, most_dofs>;
  PointJacobian jacobian(3, dofs);
  for (int i = 0; i < legs; ++i) {
    OpenTree::Leg& leg = out.legs[static_cast<std::size_t>(i)];
    mj_jacSite(&in_model, &in_data, jacobian.data(), nullptr, siteOnLeg(i));
    leg.J = jacobian.middleCols<3>(dofOf(i, 0));
    mj_jacSite(&in_model, &in_data, jacobian.data(), nullptr, siteOnPlatform(legs, i));
    leg.P = jacobian.rightCols<6>();
  }
}

void MujocoLoop::Impl::readTree(const Motion<double>& motion, const mujoco::VectorOfDofs& forces, OpenTree& out) {
  const mujoco::VectorOfDofs residual = forces - given(*model, *data, motion);
  readMaps(*model, *data, out);
  for (int i = 0; i < legs; ++i) out.legs[static_cast<std::size_t>(i)].force = residual.segment<3>(dofOf(i, 0));
  out.force = residual.tail<6>();
}

void MujocoLoop::openTree(const TreeCoordinates& at, OpenTree& out) {
  Impl& loop = *impl_;
  loop.placeTree(at);
  std::copy(at.u_dot.begin(), at.u_dot.end(), loop.data->qacc);
  loop.readTree(at.motion, loop.forcesOfTree(), out);
}

void MujocoLoop::openTree(const TreeCoordinates& at, OpenTree& out, OpenTreeMasses& masses) {
  using SquareOfDofs = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_dofs, most_dofs>;
  Impl& loop = *impl_;
  loop.placeTree(at);
  mujoco::VectorOfDofs forces(loop.dofs);
  mj_rne(loop.model.get(), loop.data.get(), 0, forces.data());
  loop.readTree(at.motion, forces, out);

  mj_crb(loop.model.get(), loop.data.get());
  SquareOfDofs mass(loop.dofs, loop.dofs);
  mj_fullM(loop.model.get(), mass.data(), loop.data->qM);
  std::fill_n(loop.data->qacc, loop.dofs, 0.0);
  mj_rnePostConstraint(loop.model.get(), loop.data.get());
  const mujoco::VectorOfGaps drift = -loop.gapAcceleration();
  for (int i = 0; i < loop.legs; ++i) {
    masses.legs[static_cast<std::size_t>(i)] = mass.block<3, 3>(dofOf(i, 0), dofOf(i, 0));
    masses.drift[static_cast<std::size_t>(i)] = drift.segment<3>(3 * i);
  }
  masses.platform = mass.bottomRightCorner<6, 6>();
}

}  // namespace ursula
