// A spanning tree of a mechanism in DART. Body w is weld w, with the world's axes at the reference pose and its origin
// in the centre.

#include <Eigen/Geometry>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <map>

#include "parts/engines/closed_mechanism.h"
#include "parts/engines/dart/dart_tree_internal.h"
#include "parts/engines/dart/silence.h"
#include "parts/engines/weld_tree.h"

namespace ursula {
namespace dart_engine {
namespace {

namespace dd = dart::dynamics;

Eigen::Isometry3d shiftedBy(const Vector3d& by) { return Eigen::Isometry3d(Eigen::Translation3d(by)); }

/// DART's rotations have only ten digits at small angles, so balls and free joints are always turned by a radian.
const Matrix3d& turned() {
  static const Matrix3d out = Eigen::AngleAxisd(1, Vector3d::UnitX()).toRotationMatrix();
  return out;
}

class DartTree : public SpeedsOfWelds {
 public:
  DartTree(const Mechanism& mechanism, const WeldedMechanism& welded, const WeldTree& tree)
      : welded_(welded),
        skeleton_(dd::Skeleton::create("machine")),
        bodies_(welded.welds.size()),
        states_(bodies_.size()) {
    skeleton_->setGravity(mechanism.gravity());
    for (const WeldStep& step : tree.steps) add(mechanism, step);
    readPose();
  }

  Eigen::Index count() const override { return static_cast<Eigen::Index>(skeleton_->getNumDofs()); }
  bool isLinear(Eigen::Index i) const override {
    const dd::DegreeOfFreedom* at = skeleton_->getDof(i);
    const dd::Joint* joint = at->getJoint();
    return joint->getType() == dd::PrismaticJoint::getStaticType() ||
           (joint->getType() == dd::FreeJoint::getStaticType() && at->getIndexInJoint() >= 3);
  }
  const WeldState& state(std::size_t weld) const override { return states_[weld]; }

  void step(const Eigen::VectorXd& by) override {
    for (dd::Joint* joint : skeleton_->getJoints()) {
      const auto first = static_cast<Eigen::Index>(joint->getIndexInSkeleton(0));
      const auto size = static_cast<Eigen::Index>(joint->getNumDofs());
      if (size >= 3)
        turn(*joint, by.segment(first, size));
      else
        joint->setPositions(joint->getPositions() + by.segment(first, size));
    }
    readPose();
  }
  void keep() override {
    kept_ = skeleton_->getPositions();
    kept_places_.clear();
    for (const dd::Joint* joint : skeleton_->getJoints())
      kept_places_.push_back(joint->getTransformFromParentBodyNode());
  }
  void goBack() override {
    for (std::size_t k = 0; k < kept_places_.size(); ++k)
      skeleton_->getJoint(k)->setTransformFromParentBodyNode(kept_places_[k]);
    skeleton_->setPositions(kept_);
    readPose();
  }
  void addRow(std::size_t weld, const Vector6d& factors, Eigen::VectorXd& row) const override {
    if (weld != 0) row += states_[weld].jacobian.transpose() * factors;
  }
  Vector6d bias(std::size_t weld) const override { return states_[weld].bias; }

  std::optional<Own> own(std::size_t joint, int index) const override {
    const auto found = joints_.find(joint);
    if (found == joints_.end() || found->second.joint->getNumDofs() > 2) return std::nullopt;
    const auto [at, reversed] = found->second;
    const int k = reversed ? static_cast<int>(at->getNumDofs()) - 1 - index : index;
    const double sign = reversed ? -1 : 1;
    return Own{static_cast<Eigen::Index>(at->getIndexInSkeleton(k)), sign, sign * at->getPosition(k)};
  }

  // [recipe]
  void readPose() {
    for (std::size_t w = 1; w < states_.size(); ++w) {
      State& at = states_[w];
      const Eigen::Isometry3d frame = bodies_[w]->getWorldTransform();
      at.R = frame.linear();
      at.c = frame.translation();
      at.jacobian = skeleton_->getWorldJacobian(bodies_[w]);  // [ω; v] of its origin, in the world's axes
    }
  }
  void setSpeeds(const Eigen::VectorXd& u) override {
    skeleton_->setVelocities(u);
    skeleton_->setAccelerations(Eigen::VectorXd::Zero(u.size()));
    for (std::size_t w = 1; w < states_.size(); ++w) {
      State& at = states_[w];
      at.w = bodies_[w]->getAngularVelocity();
      at.v = bodies_[w]->getLinearVelocity();
      at.bias << bodies_[w]->getAngularAcceleration(), bodies_[w]->getLinearAcceleration();
    }
  }
  Eigen::VectorXd forces(const Eigen::VectorXd& accelerations) override {
    skeleton_->setAccelerations(accelerations);
    skeleton_->computeInverseDynamics();
    return skeleton_->getForces();
  }
  // [/recipe]

 private:
  struct State : WeldState {
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
    Vector6d bias = Vector6d::Zero();
  };
  struct OfTree {
    dd::Joint* joint;
    bool reversed;
  };

  void add(const Mechanism& mechanism, const WeldStep& step) {
    const WeldedBodies& weld = welded_.welds[step.to];
    dd::BodyNode::AspectProperties body(std::to_string(step.to));
    body.mInertia = dd::Inertia(weld.mass, Vector3d::Zero(), weld.inertia);
    const Vector3d& before = welded_.welds[step.from].center;
    if (step.joint == WeldStep::none) {
      join<dd::FreeJoint>(step, {}, weld.center - before, Vector3d::Zero(), body);
      return;
    }
    const MechanismJoint& joint = mechanism.joints()[step.joint];
    const Vector3d in_parent = joint.centre - before, in_child = joint.centre - weld.center;
    if (joint.kind == JointKind::ball) {
      join<dd::BallJoint>(step, {}, in_parent, in_child, body);
    } else if (joint.kind == JointKind::universal) {
      dd::UniversalJoint::Properties axes;
      axes.mAxis = {joint.axis[step.reversed ? 1 : 0], joint.axis[step.reversed ? 0 : 1]};
      join<dd::UniversalJoint>(step, axes, in_parent, in_child, body);
    } else if (joint.slides()) {
      dd::PrismaticJoint::Properties axis;
      axis.mAxis = joint.axis[0];
      join<dd::PrismaticJoint>(step, axis, in_parent, in_child, body);
    } else {
      dd::RevoluteJoint::Properties axis;
      axis.mAxis = joint.axis[0];
      join<dd::RevoluteJoint>(step, axis, in_parent, in_child, body);
    }
    joints_[step.joint] = {bodies_[step.to]->getParentJoint(), step.reversed};
  }

  template <class Kind>
  void join(const WeldStep& step, typename Kind::Properties joint, const Vector3d& in_parent, const Vector3d& in_child,
            const dd::BodyNode::AspectProperties& body) {
    joint.mName = "to_" + body.mName;
    joint.mT_ParentBodyToJoint = shiftedBy(in_parent);
    joint.mT_ChildBodyToJoint = shiftedBy(in_child);
    bodies_[step.to] = skeleton_->createJointAndBodyNodePair<Kind>(bodies_[step.from], joint, body).second;
    dd::Joint& made = *bodies_[step.to]->getParentJoint();
    if (made.getNumDofs() >= 3) turn(made, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(made.getNumDofs())));
  }

  /// Moves a ball or a free joint by speeds, which are in the child's axes, and leaves it at an angle of a radian.
  static void turn(dd::Joint& joint, const Eigen::VectorXd& by) {
    const Eigen::Isometry3d to_child = joint.getTransformFromChildBodyNode();
    Eigen::Isometry3d now = joint.getRelativeTransform() * to_child;  // of the joint's frame on the child
    const Vector3d angle = by.head<3>();
    if (by.size() == 6) now.translation() += now.linear() * by.tail<3>();
    if (angle.norm() > 0) now.rotate(Eigen::AngleAxisd(angle.norm(), angle.normalized()));
    now.linear() = Eigen::Quaterniond(now.linear()).normalized().toRotationMatrix() * turned().transpose();
    joint.setTransformFromParentBodyNode(now);
    Eigen::VectorXd radian = Eigen::VectorXd::Zero(by.size());
    radian(0) = 1;
    joint.setPositions(radian);
  }

  const WeldedMechanism& welded_;
  dd::SkeletonPtr skeleton_;
  std::vector<dd::BodyNode*> bodies_;  ///< of each weld; null for the ground
  std::map<std::size_t, OfTree> joints_;
  std::vector<State> states_;
  Eigen::VectorXd kept_;
  std::vector<Eigen::Isometry3d> kept_places_;
};

}  // namespace

BuiltTree buildTree(const Mechanism& mechanism, const WeldedMechanism& welded) {
  const Silence silence;
  const WeldTree tree = weldTree(mechanism, welded);
  return {std::make_unique<DartTree>(mechanism, welded, tree), tree.cut};
}

}  // namespace dart_engine
}  // namespace ursula
