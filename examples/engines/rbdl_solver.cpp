// NOT COMPILED HERE: Debian has no RBDL. Checked: the recipe, which dart_solver.cpp shares and the tests judge; the
// names and arguments of RBDL's calls, against its public sources; the C++, by a compiler with stand-ins for the
// headers, which declare just these calls.
//
// A solver as a process that asks RBDL (2.6 or 3.x), on a file of `ursula export --format urdf`:
//
//   g++ -O2 -std=c++17 -I. -I/usr/include/eigen3 examples/engines/rbdl_solver.cpp -lrbdl -ltinyxml2
//   ursula validate scenario.toml --solver 'rbdl_solver machine.urdf [RECIPE]'
//
// RECIPE is exact, or a wrong one: tree, least_squares, no_bias. The tree is built by calls: RBDL's reader of URDF is
// an addon that many builds leave out.

#include <rbdl/rbdl.h>

#include "examples/engines/urdf_chain_internal.h"

namespace {

namespace rbd = RigidBodyDynamics;

class Rbdl : public closed_chain::Engine {
 public:
  Rbdl(const closed_chain::UrdfFile& file, const Eigen::Vector3d& gravity) : bodies_(file.links.size(), 0) {
    model_.gravity = gravity;
    for (const closed_chain::UrdfJoint& joint : file.joints) add(file, joint);
  }

  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) override {
    q_ = q;
    rates_ = rates;
    accelerations_ = accelerations;
    rbd::UpdateKinematics(model_, q_, rates_, accelerations_);
  }

  /// RBDL has angular rows first, gives orientations from the world to the body, and classical accelerations of points.
  closed_chain::Place place(int link, const Eigen::Vector3d& point) override {
    const unsigned int body = bodies_[static_cast<std::size_t>(link)];
    const rbd::Math::Vector3d at = point;
    rbd::Math::MatrixNd J = rbd::Math::MatrixNd::Zero(6, q_.size());
    rbd::CalcPointJacobian6D(model_, q_, body, at, J, false);
    const rbd::Math::SpatialVector acceleration =
        rbd::CalcPointAcceleration6D(model_, q_, rates_, accelerations_, body, at, false);
    closed_chain::Place out;
    out.position = rbd::CalcBodyToBaseCoordinates(model_, q_, body, at, false);
    out.axes = rbd::CalcBodyWorldOrientation(model_, q_, body, false).transpose();
    out.jacobian.resize(6, q_.size());
    out.jacobian << J.bottomRows(3), J.topRows(3);
    out.acceleration << acceleration.tail(3), acceleration.head(3);
    return out;
  }

  /// Leaves gravity in RBDL's accelerations, which are therefore brought back.
  Eigen::VectorXd forces() override {
    rbd::Math::VectorNd out = rbd::Math::VectorNd::Zero(q_.size());
    rbd::InverseDynamics(model_, q_, rates_, accelerations_, out);
    rbd::UpdateKinematics(model_, q_, rates_, accelerations_);
    return out;
  }

 private:
  /// RBDL numbers coordinates as bodies are added: as the file's are. A transform's matrix is from parent to joint.
  void add(const closed_chain::UrdfFile& file, const closed_chain::UrdfJoint& joint) {
    const closed_chain::UrdfLink& link = file.links[static_cast<std::size_t>(joint.child)];
    const rbd::Math::Matrix3d from_parent = joint.origin.linear().transpose();
    const rbd::Math::Vector3d origin = joint.origin.translation(), axis = joint.axis, center = link.center;
    const rbd::Math::Matrix3d inertia = link.inertia;
    const rbd::Joint kind = joint.coordinate < 0        ? rbd::Joint(rbd::JointTypeFixed)
                            : joint.type == "prismatic" ? rbd::Joint(rbd::JointTypePrismatic, axis)
                                                        : rbd::Joint(rbd::JointTypeRevolute, axis);
    bodies_[static_cast<std::size_t>(joint.child)] = model_.AddBody(
        bodies_[static_cast<std::size_t>(joint.parent)], rbd::Math::SpatialTransform(from_parent, origin), kind,
        rbd::Body(link.mass, center, inertia), link.name);
  }

  rbd::Model model_;
  std::vector<unsigned int> bodies_;
  rbd::Math::VectorNd q_, rates_, accelerations_;
};

}  // namespace

int main(int argc, char** argv) { return closed_chain::answerByUrdf<Rbdl>(argc, argv); }
