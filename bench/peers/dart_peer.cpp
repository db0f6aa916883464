// One skeleton of seven trees. The links' body frames are G = [x, e × x, e] and H = [x, s × x, s] with origins at the
// links' first ends, the platform's is M with its origin in P; φ turns about −u, ψ and θ about x, θ = 0 folds the leg.
// DART's free joint has twist and twist rate in the body's axes, [ω; v].

#include <Eigen/Geometry>
#include <array>
#include <dart/config.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <stdexcept>

#include "bench/peers/closed_rates.h"
#include "bench/peers/peer.h"
#include "parts/engines/closing.h"

namespace ursula::bench {
namespace {

namespace dd = dart::dynamics;

dd::BodyNode::AspectProperties bodyOf(const std::string& name, double mass, const Vector3d& center,
                                      const Matrix3d& inertia) {
  dd::BodyNode::AspectProperties out(name);
  out.mInertia = dd::Inertia(mass, center, inertia);
  return out;
}

/// Returns the base frame in which φ = 0 puts the leg's plane upright and ψ = 0 lays e along u.
Eigen::Isometry3d baseOf(const Leg& leg) {
  const Vector3d u = leg.base_axis.normalized(), level = u.cross(Vector3d::UnitZ());
  const Vector3d x = (level.norm() < 1e-10 ? u.cross(Vector3d::UnitY()) : level).normalized();
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() << x, u.cross(x), u;
  out.translation() = leg.base_point;
  return out;
}

struct DartLeg {
  dd::UniversalJoint* base;
  dd::RevoluteJoint* knee;
  dd::BodyNode *proximal, *distal;
};

/// Adds a body's mass in the coordinates that move it. DART computes its own mass matrix column by column from unit
/// accelerations, which takes twice as long as all the rest of the direct dynamics.
template <int Size>
Eigen::Matrix<double, Size, Size> massOf(const dd::BodyNode& body) {
  const Eigen::Matrix<double, 6, Size> J = body.getJacobian();
  return J.transpose() * body.getSpatialInertia() * J;
}

DartLeg addLeg(const dd::SkeletonPtr& skeleton, const Leg& leg, const std::string& index) {
  if (leg.kind != LegKind::URS) throw std::invalid_argument("DART's peer knows legs of the kind URS alone");
  dd::UniversalJoint::Properties at_base;
  at_base.mName = "base" + index;
  at_base.mAxis = {-Vector3d::UnitZ(), Vector3d::UnitX()};
  at_base.mT_ParentBodyToJoint = baseOf(leg);
  const auto [base, proximal] = skeleton->createJointAndBodyNodePair<dd::UniversalJoint>(
      nullptr, at_base,
      bodyOf("proximal" + index, leg.proximal.mass, leg.proximal.center_of_mass * Vector3d::UnitZ(),
             leg.proximal.inertia));
  dd::RevoluteJoint::Properties at_knee;
  at_knee.mName = "knee" + index;
  at_knee.mAxis = Vector3d::UnitX();
  at_knee.mT_ParentBodyToJoint =
      Eigen::Translation3d(0, 0, leg.proximal.length) * Eigen::Quaterniond(0, 1, 0, 0);  // half a turn about x, exactly
  const auto [knee, distal] = skeleton->createJointAndBodyNodePair<dd::RevoluteJoint>(
      proximal, at_knee,
      bodyOf("distal" + index, leg.distal.mass, leg.distal.center_of_mass * Vector3d::UnitZ(), leg.distal.inertia));
  return {base, knee, proximal, distal};
}

class DartPeer : public Peer {
 public:
  explicit DartPeer(const Manipulator& manipulator)
      : manipulator_(manipulator), skeleton_(dd::Skeleton::create("machine")) {
    if (manipulator.parameters().legs.size() != leg_count) throw std::invalid_argument("DART's peer needs six legs");
    skeleton_->setGravity(manipulator.gravity());
    for (int i = 0; i < leg_count; ++i)
      legs_[static_cast<std::size_t>(i)] = addLeg(skeleton_, manipulator.leg(i), std::to_string(i));
    const Platform& from = manipulator.platform();
    dd::FreeJoint::Properties free;
    free.mName = "free";
    std::tie(free_, platform_) = skeleton_->createJointAndBodyNodePair<dd::FreeJoint>(
        nullptr, free, bodyOf("platform", from.mass, from.center_of_mass, from.inertia));
  }

  std::string name() const override { return "DART"; }
  std::string version() const override { return DART_VERSION; }

  void coordinates(const Motion<double>& motion, const JointMotion& joints, TreeCoordinates& out) const override {
    out.motion = motion;
    for (std::vector<double>* values : {&out.q, &out.u, &out.u_dot}) values->resize(3 * leg_count + 6);
    const auto write = [](const JointVariables<double>& from, std::vector<double>& to) {
      Eigen::Map<Eigen::Matrix<double, 3, leg_count>> at(to.data());
      at.row(0) = from.phi;
      at.row(1) = from.psi;
      at.row(2) = from.theta;
    };
    write(joints.q, out.q);
    write(joints.q_dot, out.u);
    write(joints.q_ddot, out.u_dot);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = motion.Q;
    pose.translation() = motion.p;
    const Vector3d omega = motion.Q.transpose() * motion.omega, v = motion.Q.transpose() * motion.p_dot;
    const auto tail = [](std::vector<double>& of) { return Eigen::Map<Vector6d>(of.data() + 3 * leg_count); };
    tail(out.q) = dd::FreeJoint::convertToPositions(pose);
    tail(out.u) << omega, v;
    tail(out.u_dot) << motion.Q.transpose() * motion.omega_dot, motion.Q.transpose() * motion.p_ddot - omega.cross(v);
  }

  Vector6d inverseDynamics(const TreeCoordinates& at) override {
    set(at);
    accelerate(at.u_dot);
    readForces(at);
    readMaps();
    return closedEfforts(tree_, manipulator_);
  }

  Vector6d directDynamics(const TreeCoordinates& at, const Vector6d& efforts) override {
    set(at);
    accelerate(at_rest_);
    readForces(at);
    readMaps();
    for (std::size_t i = 0; i < leg_count; ++i) {
      masses_.legs[i] = massOf<3>(*legs_[i].distal);
      masses_.legs[i].topLeftCorner<2, 2>() += massOf<2>(*legs_[i].proximal);
      masses_.drift[i] = platform_->getLinearAcceleration(manipulator_.leg(static_cast<int>(i)).platform_point) -
                         legs_[i].distal->getLinearAcceleration(tipOf(i));
    }
    masses_.platform = massOf<6>(*platform_);
    const Vector6d rates = closedRates(tree_, masses_, manipulator_, efforts);
    const Eigen::Map<const Vector6d> twist(at.u.data() + 3 * leg_count);
    Vector6d out;
    out << at.motion.Q * rates.head<3>(), at.motion.Q * (rates.tail<3>() + twist.head<3>().cross(twist.tail<3>()));
    return out;
  }

 private:
  Vector3d tipOf(std::size_t leg) const { return {0, 0, manipulator_.leg(static_cast<int>(leg)).distal.length}; }

  void set(const TreeCoordinates& at) {
    for (std::size_t i = 0; i < leg_count; ++i) {
      const double *q = at.q.data() + 3 * i, *u = at.u.data() + 3 * i;
      legs_[i].base->setPositionsStatic({q[0], q[1]});
      legs_[i].knee->setPositionsStatic(Eigen::Matrix<double, 1, 1>(q[2]));
      legs_[i].base->setVelocitiesStatic({u[0], u[1]});
      legs_[i].knee->setVelocitiesStatic(Eigen::Matrix<double, 1, 1>(u[2]));
    }
    free_->setPositionsStatic(Eigen::Map<const Vector6d>(at.q.data() + 3 * leg_count));
    free_->setVelocitiesStatic(Eigen::Map<const Vector6d>(at.u.data() + 3 * leg_count));
  }

  void accelerate(const std::vector<double>& u_dot) {
    for (std::size_t i = 0; i < leg_count; ++i) {
      const double* a = u_dot.data() + 3 * i;
      legs_[i].base->setAccelerationsStatic({a[0], a[1]});
      legs_[i].knee->setAccelerationsStatic(Eigen::Matrix<double, 1, 1>(a[2]));
    }
    free_->setAccelerationsStatic(Eigen::Map<const Vector6d>(u_dot.data() + 3 * leg_count));
  }

  /// Reads the forces for the accelerations that were set.
  void readForces(const TreeCoordinates& at) {
    skeleton_->computeInverseDynamics();
    for (std::size_t i = 0; i < leg_count; ++i)
      tree_.legs[i].force << legs_[i].base->getForce(0), legs_[i].base->getForce(1), legs_[i].knee->getForce(0);
    for (std::size_t k = 0; k < 6; ++k) tree_.force(static_cast<int>(k)) = free_->getForce(k);
    addFriction(at);
  }

  /// Velocities of the points Bᵢ, in B. DART's Jacobians are of the bodies' origins, [angular; linear].
  void readMaps() {
    const dart::math::Jacobian& of_platform = platform_->getWorldJacobian();
    const Matrix3d Q = platform_->getWorldTransform().linear();
    for (std::size_t i = 0; i < leg_count; ++i) {
      const dart::math::Jacobian& of_leg = legs_[i].distal->getWorldJacobian();
      const Vector3d to_tip = legs_[i].distal->getWorldTransform().linear() * tipOf(i);
      const Vector3d arm = Q * manipulator_.leg(static_cast<int>(i)).platform_point;
      for (int k = 0; k < 3; ++k)
        tree_.legs[i].J.col(k) = of_leg.col(k).tail<3>() + of_leg.col(k).head<3>().cross(to_tip);
      for (int k = 0; k < 6; ++k)
        tree_.legs[i].P.col(k) = of_platform.col(k).tail<3>() + of_platform.col(k).head<3>().cross(arm);
    }
  }

  void addFriction(const TreeCoordinates& at) {
    for (std::size_t i = 0; i < leg_count; ++i) {
      const Leg& leg = manipulator_.leg(static_cast<int>(i));
      if (!leg.friction.any() && !leg.coulomb.any()) continue;
      const auto& coordinates = rowOf(leg.kind).coordinates;
      for (std::size_t joint = 0; joint < 3; ++joint) {
        const double rate = at.u[3 * i + joint];
        const Coordinate coordinate = coordinates[joint];
        tree_.legs[i].force(static_cast<int>(joint)) +=
            leg.friction.on(coordinate) * rate +
            leg.coulomb.on(coordinate) * std::tanh(rate / leg.coulomb.speedOf(coordinate));
      }
    }
  }

  Manipulator manipulator_;
  dd::SkeletonPtr skeleton_;
  std::array<DartLeg, leg_count> legs_{};
  dd::FreeJoint* free_ = nullptr;
  dd::BodyNode* platform_ = nullptr;
  std::vector<double> at_rest_ = std::vector<double>(3 * leg_count + 6, 0.0);
  OpenTree tree_;
  OpenTreeMasses masses_;
};

}  // namespace

std::unique_ptr<Peer> makeDartPeer(const Manipulator& manipulator) { return std::make_unique<DartPeer>(manipulator); }

bool dartAvailable() { return true; }

}  // namespace ursula::bench
