// NOT COMPILED HERE: Debian has no Pinocchio. Checked: the recipe, which dart_solver.cpp shares and the tests judge;
// the names and arguments of Pinocchio's calls, against its public sources; the C++, by a compiler with stand-ins for
// the headers, which declare just these calls.
//
// A solver as a process that asks Pinocchio 3, on a file of `ursula export --format urdf`:
//
//   g++ -O2 -std=c++17 -I. examples/engines/pinocchio_solver.cpp $(pkg-config --cflags --libs pinocchio) -ltinyxml2
//   ursula validate scenario.toml --solver 'pinocchio_solver machine.urdf [RECIPE]'
//
// RECIPE is exact, or a wrong one: tree, least_squares, no_bias. Pinocchio's own reader of URDF gives a continuous
// joint two coordinates, cosine and sine; the tree is built here by calls, with one angle for each joint.

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/joint/joint-collection.hpp>
#include <pinocchio/multibody/model.hpp>

#include "examples/engines/urdf_chain_internal.h"

namespace {

class Pinocchio : public closed_chain::Engine {
 public:
  Pinocchio(const closed_chain::UrdfFile& file, const Eigen::Vector3d& gravity) : carriers_(file.links.size()) {
    model_.gravity.linear() = gravity;
    for (const closed_chain::UrdfJoint& joint : file.joints) add(file, joint);
    data_ = pinocchio::Data(model_);
  }

  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) override {
    q_ = q;
    rates_ = rates;
    accelerations_ = accelerations;
    pinocchio::computeJointJacobians(model_, data_, q_);
    pinocchio::forwardKinematics(model_, data_, q_, rates_, accelerations_);
  }

  /// Classical accelerations, not spatial ones, which lack ω × v.
  closed_chain::Place place(int link, const Eigen::Vector3d& point) override {
    const Carrier& carrier = carriers_[static_cast<std::size_t>(link)];
    const pinocchio::SE3 at = carrier.placement * pinocchio::SE3(Eigen::Matrix3d::Identity(), point);
    const pinocchio::SE3 world = data_.oMi[carrier.joint] * at;
    pinocchio::Data::Matrix6x J = pinocchio::Data::Matrix6x::Zero(6, model_.nv);
    pinocchio::getFrameJacobian(model_, data_, carrier.joint, at, pinocchio::LOCAL_WORLD_ALIGNED, J);
    const pinocchio::Motion acceleration =
        pinocchio::getFrameClassicalAcceleration(model_, data_, carrier.joint, at, pinocchio::LOCAL_WORLD_ALIGNED);
    closed_chain::Place out{world.translation(), world.rotation(), J, {}};
    out.acceleration << acceleration.linear(), acceleration.angular();
    return out;
  }

  Eigen::VectorXd forces() override { return pinocchio::rnea(model_, data_, q_, rates_, accelerations_); }

 private:
  /// The joint that moves a link, and the link's frame in the joint's.
  struct Carrier {
    pinocchio::JointIndex joint = 0;
    pinocchio::SE3 placement = pinocchio::SE3::Identity();
  };

  /// Pinocchio numbers coordinates as joints are added: as the file's are.
  void add(const closed_chain::UrdfFile& file, const closed_chain::UrdfJoint& joint) {
    const Carrier& parent = carriers_[static_cast<std::size_t>(joint.parent)];
    Carrier& child = carriers_[static_cast<std::size_t>(joint.child)];
    const pinocchio::SE3 at = parent.placement * pinocchio::SE3(joint.origin.linear(), joint.origin.translation());
    if (joint.coordinate < 0) {
      child = {parent.joint, at};
    } else {
      child.joint =
          joint.type == "prismatic"
              ? model_.addJoint(parent.joint, pinocchio::JointModelPrismaticUnaligned(joint.axis), at, joint.name)
              : model_.addJoint(parent.joint, pinocchio::JointModelRevoluteUnaligned(joint.axis), at, joint.name);
    }
    const closed_chain::UrdfLink& link = file.links[static_cast<std::size_t>(joint.child)];
    if (link.mass == 0) return;
    const pinocchio::Inertia inertia(link.mass, link.center, link.inertia);
    model_.appendBodyToJoint(child.joint, inertia, child.placement);
  }

  pinocchio::Model model_;
  pinocchio::Data data_;
  std::vector<Carrier> carriers_;
  Eigen::VectorXd q_, rates_, accelerations_;
};

}  // namespace

int main(int argc, char** argv) { return closed_chain::answerByUrdf<Pinocchio>(argc, argv); }
