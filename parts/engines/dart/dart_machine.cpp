// The links' body frames are those of the scenario, with origins at the links' first ends. A rod in a cylinder has its
// origin at its inner end. The platform's frame is M, with its origin in P.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <stdexcept>

#include "parts/engines/dart/dart_machine_internal.h"
#include "parts/engines/dart/silence.h"

namespace ursula::dart_engine {
namespace {

namespace dd = dart::dynamics;

dd::BodyNode::AspectProperties bodyOf(const std::string& name, const Link& link, const Vector3d& center) {
  dd::BodyNode::AspectProperties out(name);
  out.mInertia = dd::Inertia(link.mass, center, link.inertia);
  return out;
}

/// Joins the body to its parent by the joint's kind and properties, at `place` in the parent.
template <class Kind>
dd::BodyNode* add(const dd::SkeletonPtr& skeleton, dd::BodyNode* parent, typename Kind::Properties joint,
                  const Eigen::Isometry3d& place, const dd::BodyNode::AspectProperties& body) {
  joint.mName = "to_" + body.mName;
  joint.mT_ParentBodyToJoint = place;
  return skeleton->createJointAndBodyNodePair<Kind>(parent, joint, body).second;
}

template <class Kind>
typename Kind::Properties about(const Vector3d& axis) {
  typename Kind::Properties out;
  out.mAxis = axis;
  return out;
}

dd::UniversalJoint::Properties universal(const Vector3d& first, const Vector3d& second) {
  dd::UniversalJoint::Properties out;
  out.mAxis = {first, second};
  return out;
}

/// Adds a leg's body behind its one or two joints; two make a universal joint.
dd::BodyNode* addBody(const dd::SkeletonPtr& skeleton, dd::BodyNode* parent, const LegChain& chain, int link,
                      const std::string& name) {
  const auto properties = bodyOf(name, chain.links[link], chain.centers[link]);
  const int first = chain.firstOf(link);
  const Vector3d& axis = chain.joint(first).axis;
  const Eigen::Isometry3d place = chain.place(first);
  if (chain.jointsOf(link) == 2)
    return add<dd::UniversalJoint>(skeleton, parent, universal(axis, chain.joint(first + 1).axis), place, properties);
  if (chain.slides(first))
    return add<dd::PrismaticJoint>(skeleton, parent, about<dd::PrismaticJoint>(axis), place, properties);
  return add<dd::RevoluteJoint>(skeleton, parent, about<dd::RevoluteJoint>(axis), place, properties);
}

Eigen::Isometry3d placeOf(const Matrix3d& R, const Vector3d& at) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = R;
  out.translation() = at;
  return out;
}

}  // namespace

DartMachine::DartMachine(const Manipulator& from) : manipulator(from), skeleton(dd::Skeleton::create("machine")) {
  const Silence silence;
  skeleton->setGravity(from.gravity());
  for (int i = 0; i < from.legCount(); ++i) addLeg(from.leg(i), std::to_string(i));
  dd::BodyNode::AspectProperties body("platform");
  body.mInertia = dd::Inertia(from.platform().mass, from.platform().center_of_mass, from.platform().inertia);
  std::tie(free, platform) =
      skeleton->createJointAndBodyNodePair<dd::FreeJoint>(nullptr, dd::FreeJoint::Properties(), body);
}

void DartMachine::addLeg(const Leg& leg, const std::string& index) {
  const LegChain chain = chainOf(leg);
  DartLeg out;
  dd::BodyNode* proximal = addBody(skeleton, nullptr, chain, 0, "proximal" + index);
  out.distal = addBody(skeleton, proximal, chain, 1, "distal" + index);
  out.joints = {proximal->getParentJoint(), out.distal->getParentJoint()};
  out.tip = chain.tip;
  legs.push_back(out);
}

void DartMachine::move(const Motion<double>& motion, bool with_bias) {
  const Vector3d omega = motion.Q.transpose() * motion.omega, v = motion.Q.transpose() * motion.p_dot;
  Vector6d twist, rate;
  twist << omega, v;
  rate << motion.Q.transpose() * motion.omega_dot, motion.Q.transpose() * motion.p_ddot - omega.cross(v);
  // DART's rotations have only ten digits at small angles, so the joint is always turned by a radian.
  const Matrix3d turned = Eigen::AngleAxisd(1, Vector3d::UnitX()).toRotationMatrix();
  free->setTransformFromParentBodyNode(placeOf(motion.Q * turned.transpose(), motion.p));
  free->setPositions(dd::FreeJoint::convertToPositions(placeOf(turned, Vector3d::Zero())));
  free->setVelocities(twist);
  free->setAccelerations(rate);
  constexpr int newton_steps = 3;  // geometry loses half the digits if a leg is nearly stretched
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& from = manipulator.leg(static_cast<int>(i));
    const auto set = [&leg = legs[i]](const Vector3d& values, auto setter) {
      for (int j = 0; j < 3; ++j) {
        const auto [joint, which] = leg.place(j);
        (joint->*setter)(which, values(j));
      }
    };
    const Vector3d& b = from.platform_point;
    const Vector3d B = motion.p + motion.Q * b;
    Vector3d q = legCoordinates(from, static_cast<int>(i), fixedFrame(from.base_axis), motion);
    const auto J = [&leg = legs[i]] { return Matrix3d(leg.distal->getLinearJacobian(leg.tip, dd::Frame::World())); };
    for (int step = 0; step < newton_steps; ++step) {
      set(q, &dd::Joint::setPosition);
      q -= J().partialPivLu().solve(legs[i].distal->getWorldTransform() * legs[i].tip - B);
    }
    set(q, &dd::Joint::setPosition);
    const Eigen::PartialPivLU<Matrix3d> factors(J());
    set(factors.solve(platform->getLinearVelocity(b)), &dd::Joint::setVelocity);
    set(Vector3d::Zero(), &dd::Joint::setAcceleration);
    const Eigen::Matrix<double, 3, 6> of_platform = platform->getLinearJacobian(b, dd::Frame::World());
    const Vector3d wanted =
        with_bias ? Vector3d(platform->getLinearAcceleration(b) - legs[i].distal->getLinearAcceleration(legs[i].tip))
                  : Vector3d(of_platform * rate);
    set(factors.solve(wanted), &dd::Joint::setAcceleration);
  }
}

void DartMachine::readMaps(PlacedTree& out) {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Vector3d& b = manipulator.leg(static_cast<int>(i)).platform_point;
    out.legs[i].J = legs[i].distal->getLinearJacobian(legs[i].tip, dd::Frame::World());
    out.legs[i].P = platform->getLinearJacobian(b, dd::Frame::World());
    out.gaps[i] = legs[i].distal->getWorldTransform() * legs[i].tip - platform->getWorldTransform() * b;
  }
}

double DartMachine::coordinate(int leg, int j) const {
  const auto [joint, which] = legs[leg].place(j);
  return joint->getPosition(which);
}

Vector3d DartMachine::rates(int leg) const {
  Vector3d out;
  for (int j = 0; j < 3; ++j) {
    const auto [joint, which] = legs[static_cast<std::size_t>(leg)].place(j);
    out(j) = joint->getVelocity(which);
  }
  return out;
}

void DartMachine::close(const Rigidity& rigidity) {
  rigidity_ = rigidity;
  world_ = dart::simulation::World::create();
  world_->setGravity(manipulator.gravity());
  world_->setTimeStep(rigidity.step);
  world_->addSkeleton(skeleton);
  chooseUnit();
  for (const DartLeg& leg : legs)
    world_->getConstraintSolver()->addConstraint(std::make_shared<dart::constraint::BallJointConstraint>(
        leg.distal, platform, leg.distal->getWorldTransform() * leg.tip));
}

/// DART ends the process if its constraints' matrix is not symmetric to 1e-6. This unit of mass brings the matrix's
/// entries near 1. All forces are in that unit.
void DartMachine::chooseUnit() {
  PlacedTree tree;
  readMaps(tree);
  const Eigen::MatrixXd M = skeleton->getMassMatrix();
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(legs[i].joints[0]->getIndexInSkeleton(0));
    const Matrix3d& J = tree.legs[i].J;
    unit_ = std::max(i == 0 ? 0 : unit_, (J * M.block<3, 3>(first, first).inverse() * J.transpose()).norm());
  }
  if (!std::isfinite(unit_) || !(unit_ > 0)) throw std::runtime_error("DART moves no legs without mass");
  for (dd::BodyNode* body : skeleton->getBodyNodes()) {
    const Silence silence;
    const dd::Inertia& inertia = body->getInertia();
    body->setInertia(
        dd::Inertia(unit_ * inertia.getMass(), inertia.getLocalCOM(), Matrix3d(unit_ * inertia.getMoment())));
  }
}

/// DART's own potential energy assumes masses at the bodies' origins.
double DartMachine::energy() {
  const double potential = skeleton->getMass() * manipulator.gravity().dot(skeleton->getCOM());
  return (skeleton->computeKineticEnergy() - potential) / unit_;
}

void DartMachine::addEffort(int leg, int j, double effort) {
  const auto [joint, which] = legs[leg].place(j);
  joint->setForce(which, joint->getForce(which) + unit_ * effort);
}

void DartMachine::addFrictionAndLoad(const Load* load, double t) {
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const Vector3d acts = friction(i);
    for (int j = 0; j < 3; ++j) addEffort(i, j, acts(j));
  }
  const Vector6d w = loadInBase(load, t, platform->getWorldTransform().linear());
  platform->addExtForce(unit_ * w.tail<3>(), Vector3d::Zero(), false, true);
  platform->addExtTorque(unit_ * w.head<3>(), false);
}

double DartMachine::powerOfFrictionAndLoad(const Load* load, double t) const {
  const Vector6d w = loadInBase(load, t, platform->getWorldTransform().linear());
  double out = w.head<3>().dot(platform->getAngularVelocity()) + w.tail<3>().dot(platform->getLinearVelocity());
  for (int i = 0; i < manipulator.legCount(); ++i) out += friction(i).dot(rates(i));
  return out;
}

/// DART's constants are global, so each step sets them.
void DartMachine::step() {
  using dart::constraint::DynamicJointConstraint;
  DynamicJointConstraint::setErrorReductionParameter(rigidity_.settings.at(0).second);
  DynamicJointConstraint::setConstraintForceMixing(rigidity_.settings.at(1).second);
  world_->step();
  if (!skeleton->getPositions().allFinite()) throw std::runtime_error("DART's state is not finite");
}

}  // namespace ursula::dart_engine
