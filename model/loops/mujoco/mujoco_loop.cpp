// Open trees with hinges q_L and a free platform q_P. The loops are closed where the distal link's and the platform's
// point Bᵢ coincide; G = [G_L G_P] is the Jacobian of the six gaps.
//
//   G_L q̇_L = −G_P q̇_P                                                                                         (1)
//   G_L q̈_L = −(the gaps' acceleration with q̈_L = 0)                                                            (2)
//   Gᵀλ + Sτ = M q̈ + bias − friction − load, S picking the φᵢ                                                   (3)
//
// MuJoCo gives G, the accelerations in (2) and M q̈ + bias; its constraints, contacts and integrators have no part.

#include "model/loops/mujoco/mujoco_loop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/loops/mujoco/mujoco_loop_internal.h"

namespace ursula {
namespace {

using mujoco::dofs, mujoco::joints_per_leg, mujoco::leg_dofs, mujoco::platform_body;
using mujoco::siteOnLeg, mujoco::siteOnPlatform, mujoco::universalFrame;

using GapJacobian = Eigen::Matrix<double, leg_dofs, dofs>;  ///< three gaps a leg: as many as a leg has joints
using VectorOfDofs = Eigen::Matrix<double, dofs, 1>;
using SquareOfDofs = Eigen::Matrix<double, dofs, dofs>;

/// The angle between sides a and b of a triangle, opposite to c; exact to rounding for needles, too (Kahan,
/// Miscalculating Area and Angles of a Needle-like Triangle, 2014, sect. 2).
double angleOpposite(double c, double a, double b) {
  if (a < b) std::swap(a, b);
  const double slack = b >= c ? c - (a - b) : b - (a - c);
  const double top = ((a - b) + c) * slack, bottom = (a + (b + c)) * ((a - c) + b);
  return 2 * std::atan2(std::sqrt(std::max(top, 0.0)), std::sqrt(std::max(bottom, 0.0)));
}

/// φ, ψ, θ of the hinges, φ from where buildModel has its zero.
Vector3d hingeAngles(const Leg& leg, int index, const Motion<double>& motion) {
  const double l = leg.proximal.length, s = leg.distal.length;
  const Vector3d AB = motion.p + motion.Q * leg.platform_point - leg.base_point;
  const double q = AB.norm();
  if (!(q <= l + s && q >= std::abs(l - s)))
    throw std::domain_error(fmt::format("leg {} cannot reach over {} m at t = {} s", index + 1, q, motion.t));
  const Matrix3d zero = universalFrame(leg);
  const Vector3d u = zero.col(2), across = u.cross(AB);
  const double side = leg.knee == Knee::positive ? 1 : -1;
  return {std::atan2(-across.dot(zero.col(1)), across.dot(zero.col(0))),
          std::atan2(across.norm(), u.dot(AB)) + side * angleOpposite(s, l, q), side * angleOpposite(q, l, s)};
}

Vector3d centroidOfBase(const Manipulator& manipulator) {
  Vector3d sum = Vector3d::Zero();
  for (const Leg& leg : manipulator.parameters().legs) sum += leg.base_point;
  return sum / leg_count;
}

double friction(double viscous, double coulomb, double speed, double rate) {
  return -viscous * rate - coulomb * std::tanh(rate / speed);
}

Vector3d frictionOf(const Leg& leg, const Vector3d& rates) {
  const double speed = leg.coulomb.smoothing_speed;
  return {friction(leg.friction.phi, leg.coulomb.phi, speed, rates(0)),
          friction(leg.friction.psi, leg.coulomb.psi, speed, rates(1)),
          friction(leg.friction.theta, leg.coulomb.theta, speed, rates(2))};
}

}  // namespace

struct MujocoLoop::Impl {
  Impl(const Manipulator& from, std::shared_ptr<const Load> on_platform)
      : manipulator(from),
        load(std::move(on_platform)),
        origin(centroidOfBase(from)),
        model(mujoco::buildModel(from, origin)),
        data(mj_makeData(model.get())) {
    if (!data) throw std::runtime_error("MuJoCo: no memory for its data");
  }

  void place(const Motion<double>& motion);
  void move(const Motion<double>& motion);
  GapJacobian gapJacobian() const;
  Eigen::Matrix<double, leg_dofs, 1> gapAcceleration() const;
  VectorOfDofs unbalanced(const Motion<double>& motion) const;

  Manipulator manipulator;
  std::shared_ptr<const Load> load;
  Vector3d origin;  ///< B's origin may be far from the machine, MuJoCo's world is not
  mujoco::Model model;
  mujoco::Data data;
  GapJacobian G;
};

void MujocoLoop::Impl::place(const Motion<double>& motion) {
  for (int leg = 0; leg < leg_count; ++leg)
    Eigen::Map<Vector3d>(data->qpos + joints_per_leg * leg) = hingeAngles(manipulator.leg(leg), leg, motion);
  const Eigen::Quaterniond Q(motion.Q);
  Eigen::Map<Vector3d>(data->qpos + leg_dofs) = (motion.p - origin) + motion.Q * manipulator.platform().center_of_mass;
  Eigen::Map<Eigen::Vector4d>(data->qpos + leg_dofs + 3) << Q.w(), Q.x(), Q.y(), Q.z();
  mj_kinematics(model.get(), data.get());
  mj_comPos(model.get(), data.get());
  G = gapJacobian();
}

/// MuJoCo's free joint has its linear part in the world and its angular part in the body.
void MujocoLoop::Impl::move(const Motion<double>& motion) {
  const Vector3d arm = motion.Q * manipulator.platform().center_of_mass;
  Eigen::Map<VectorOfDofs> rates(data->qvel), accelerations(data->qacc);
  const Eigen::PartialPivLU<Eigen::Matrix<double, leg_dofs, leg_dofs>> factors(G.leftCols<leg_dofs>());

  rates.tail<6>() << motion.p_dot + motion.omega.cross(arm), motion.Q.transpose() * motion.omega;
  rates.head<leg_dofs>() = -factors.solve(G.rightCols<6>() * rates.tail<6>());  // (1)
  mj_comVel(model.get(), data.get());

  accelerations.head<leg_dofs>().setZero();
  accelerations.tail<6>() << motion.p_ddot + motion.omega_dot.cross(arm) + motion.omega.cross(motion.omega.cross(arm)),
      motion.Q.transpose() * motion.omega_dot;
  mj_rnePostConstraint(model.get(), data.get());
  accelerations.head<leg_dofs>() = -factors.solve(gapAcceleration());  // (2)
}

GapJacobian MujocoLoop::Impl::gapJacobian() const {
  using RowMajor = Eigen::Matrix<double, 3, dofs, Eigen::RowMajor>;
  GapJacobian jacobian;
  RowMajor on_leg, on_platform;
  for (int leg = 0; leg < leg_count; ++leg) {
    mj_jacSite(model.get(), data.get(), on_leg.data(), nullptr, siteOnLeg(leg));
    mj_jacSite(model.get(), data.get(), on_platform.data(), nullptr, siteOnPlatform(leg));
    jacobian.middleRows<3>(3 * leg) = on_leg - on_platform;
  }
  return jacobian;
}

/// Gravity is in MuJoCo's accelerations; it cancels.
Eigen::Matrix<double, leg_dofs, 1> MujocoLoop::Impl::gapAcceleration() const {
  const auto linear = [&](int site) {
    Vector6d angular_and_linear;
    mj_objectAcceleration(model.get(), data.get(), mjOBJ_SITE, site, angular_and_linear.data(), 0);
    return Vector3d(angular_and_linear.tail<3>());
  };
  Eigen::Matrix<double, leg_dofs, 1> gaps;
  for (int leg = 0; leg < leg_count; ++leg)
    gaps.segment<3>(3 * leg) = linear(siteOnLeg(leg)) - linear(siteOnPlatform(leg));
  return gaps;
}

/// The right-hand side of (3).
VectorOfDofs MujocoLoop::Impl::unbalanced(const Motion<double>& motion) const {
  VectorOfDofs forces, given = VectorOfDofs::Zero();
  mj_rne(model.get(), data.get(), 1, forces.data());
  for (int leg = 0; leg < leg_count; ++leg)
    given.segment<3>(joints_per_leg * leg) =
        frictionOf(manipulator.leg(leg), Eigen::Map<const Vector3d>(data->qvel + joints_per_leg * leg));
  if (load) {
    const Wrench<double> wrench = load->at(motion.t);
    const bool in_platform = load->frame == Load::Frame::platform;
    const Vector3d force = in_platform ? motion.Q * wrench.force : wrench.force;
    const Vector3d moment = in_platform ? motion.Q * wrench.moment : wrench.moment;
    const Vector3d point = (motion.p - origin) + motion.Q * load->point;
    mj_applyFT(model.get(), data.get(), force.data(), moment.data(), point.data(), platform_body, given.data());
  }
  return forces - given;
}

MujocoLoop::MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load)
    : impl_(std::make_unique<Impl>(manipulator, std::move(load))) {}

MujocoLoop::~MujocoLoop() = default;

Vector6d MujocoLoop::inverseDynamics(const Motion<double>& motion) {
  impl_->place(motion);
  impl_->move(motion);
  SquareOfDofs multipliers_and_torques = SquareOfDofs::Zero();
  multipliers_and_torques.leftCols<leg_dofs>() = impl_->G.transpose();
  for (int leg = 0; leg < leg_count; ++leg) multipliers_and_torques(joints_per_leg * leg, leg_dofs + leg) = 1;
  const Eigen::PartialPivLU<SquareOfDofs> factors(multipliers_and_torques);
  return factors.solve(impl_->unbalanced(motion)).tail<6>();  // (3)
}

bool mujocoAvailable() { return true; }

std::string mujocoVersion() { return mj_versionString(); }

}  // namespace ursula
