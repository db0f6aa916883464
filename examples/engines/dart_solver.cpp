// A solver as a process that asks DART 6, on the model that `ursula export --format urdf` wrote:
//
//   ursula export scenario.toml --format urdf --out machine.urdf
//   ursula validate scenario.toml --solver 'dart_solver machine.urdf [RECIPE]'
//
// RECIPE is exact, or one that is often taken instead and is wrong: tree, least_squares, no_bias. A scenario's load is
// not in the file, nor the smoothing of its dry friction. DART's own reader of URDF gives links without inertia 1 kg,
// and knows no loops: the tree is built here by calls.

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>

#include "examples/engines/urdf_chain_internal.h"

namespace {

namespace dd = dart::dynamics;

class Dart : public closed_chain::Engine {
 public:
  Dart(const closed_chain::UrdfFile& file, const Eigen::Vector3d& gravity)
      : skeleton_(dd::Skeleton::create("machine")), bodies_(file.links.size(), nullptr) {
    skeleton_->setGravity(gravity);
    std::cerr.setstate(std::ios::failbit);  // DART warns of each body without mass; inverse dynamics needs none
    for (const closed_chain::UrdfJoint& joint : file.joints) add(file, joint);
    std::cerr.clear();
    for (const closed_chain::UrdfJoint& joint : file.joints) {
      if (joint.coordinate < 0) continue;
      const dd::BodyNode* moved = bodies_[static_cast<std::size_t>(joint.child)];
      places_.push_back(static_cast<Eigen::Index>(moved->getParentJoint()->getIndexInSkeleton(0)));
    }
  }

  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) override {
    skeleton_->setPositions(toDart(q));
    skeleton_->setVelocities(toDart(rates));
    skeleton_->setAccelerations(toDart(accelerations));
  }

  /// DART's accelerations of points are classical ones, and have no part of gravity.
  closed_chain::Place place(int link, const Eigen::Vector3d& point) override {
    const dd::BodyNode* body = bodies_[static_cast<std::size_t>(link)];
    const Eigen::Isometry3d& frame = body->getWorldTransform();
    Eigen::MatrixXd of_dart(6, q_size());
    of_dart << skeleton_->getLinearJacobian(body, point), skeleton_->getAngularJacobian(body);
    closed_chain::Place out{frame * point, frame.linear(), Eigen::MatrixXd(6, q_size()), {}};
    for (Eigen::Index k = 0; k < q_size(); ++k) out.jacobian.col(k) = of_dart.col(places_[static_cast<std::size_t>(k)]);
    out.acceleration << body->getLinearAcceleration(point), body->getAngularAcceleration();
    return out;
  }

  Eigen::VectorXd forces() override {
    skeleton_->computeInverseDynamics();
    const Eigen::VectorXd of_dart = skeleton_->getForces();
    Eigen::VectorXd out(q_size());
    for (Eigen::Index k = 0; k < q_size(); ++k) out(k) = of_dart(places_[static_cast<std::size_t>(k)]);
    return out;
  }

 private:
  Eigen::Index q_size() const { return static_cast<Eigen::Index>(places_.size()); }

  Eigen::VectorXd toDart(const Eigen::VectorXd& of_file) const {
    Eigen::VectorXd out(q_size());
    for (Eigen::Index k = 0; k < q_size(); ++k) out(places_[static_cast<std::size_t>(k)]) = of_file(k);
    return out;
  }

  void add(const closed_chain::UrdfFile& file, const closed_chain::UrdfJoint& joint) {
    if (joint.type == "fixed") {
      addBy<dd::WeldJoint>(file, joint, {});
    } else if (joint.type == "prismatic") {
      dd::PrismaticJoint::Properties properties;
      properties.mAxis = joint.axis;
      addBy<dd::PrismaticJoint>(file, joint, properties);
    } else {
      dd::RevoluteJoint::Properties properties;
      properties.mAxis = joint.axis;
      addBy<dd::RevoluteJoint>(file, joint, properties);
    }
  }

  /// The base is DART's world: it has no body.
  template <class Kind>
  void addBy(const closed_chain::UrdfFile& file, const closed_chain::UrdfJoint& joint,
             typename Kind::Properties properties) {
    const closed_chain::UrdfLink& link = file.links[static_cast<std::size_t>(joint.child)];
    properties.mName = joint.name;
    properties.mT_ParentBodyToJoint = joint.origin;
    dd::BodyNode::AspectProperties body(link.name);
    body.mInertia = dd::Inertia(link.mass, link.center, link.inertia);
    dd::BodyNode* parent = bodies_[static_cast<std::size_t>(joint.parent)];
    bodies_[static_cast<std::size_t>(joint.child)] =
        skeleton_->createJointAndBodyNodePair<Kind>(parent, properties, body).second;
  }

  dd::SkeletonPtr skeleton_;
  std::vector<dd::BodyNode*> bodies_;
  std::vector<Eigen::Index> places_;  ///< of the file's coordinates, in DART
};

}  // namespace

int main(int argc, char** argv) { return closed_chain::answerByUrdf<Dart>(argc, argv); }
