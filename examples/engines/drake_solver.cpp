// NOT COMPILED HERE: Debian has no Drake. Checked: the recipe, which dart_solver.cpp shares and the tests judge; the
// names and arguments of Drake's calls, against its public sources; the C++, by a compiler with stand-ins for the
// headers, which declare just these calls.
//
// A solver as a process that asks Drake (1.30 or later), on a file of `ursula export --format urdf`:
//
//   find_package(drake REQUIRED), target_link_libraries(drake_solver drake::drake tinyxml2)
//   ursula validate scenario.toml --solver 'drake_solver machine.urdf [RECIPE]'
//
// RECIPE is exact, or a wrong one: tree, least_squares, no_bias. Drake's reader makes <drake:ball_constraint> a
// constraint of its discrete solvers, which inverse dynamics leaves out: the tree is built by calls.

#include <drake/multibody/plant/multibody_plant.h>
#include <drake/multibody/tree/prismatic_joint.h>
#include <drake/multibody/tree/revolute_joint.h>

#include <memory>

#include "examples/engines/urdf_chain_internal.h"

namespace {

namespace dm = drake::multibody;

class Drake : public closed_chain::Engine {
 public:
  Drake(const closed_chain::UrdfFile& file, const Eigen::Vector3d& gravity) : bodies_(file.links.size(), nullptr) {
    plant_.mutable_gravity_field().set_gravity_vector(gravity);
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      bodies_[k] = isCarried(file, static_cast<int>(k))
                       ? &plant_.AddRigidBody(file.links[k].name, inertiaOf(file.links[k]))
                       : &plant_.world_body();
    for (const closed_chain::UrdfJoint& joint : file.joints) add(joint);
    plant_.Finalize();
    context_ = plant_.CreateDefaultContext();
    for (const dm::Joint<double>* joint : joints_) places_.push_back(joint->velocity_start());
  }

  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) override {
    accelerations_ = toDrake(accelerations);
    plant_.SetPositions(context_.get(), toDrake(q));
    plant_.SetVelocities(context_.get(), toDrake(rates));
    of_bodies_.resize(static_cast<std::size_t>(plant_.num_bodies()));
    plant_.CalcSpatialAccelerationsFromVdot(*context_, accelerations_, &of_bodies_);
  }

  /// Drake has angular rows first. Its accelerations are those of bodies' origins, classical ones.
  closed_chain::Place place(int link, const Eigen::Vector3d& point) override {
    const dm::RigidBody<double>& body = *bodies_[static_cast<std::size_t>(link)];
    const drake::math::RigidTransform<double>& pose = plant_.EvalBodyPoseInWorld(*context_, body);
    const Eigen::Matrix3d axes = pose.rotation().matrix();
    const Eigen::Vector3d arm = axes * point;
    const Eigen::Vector3d w = plant_.EvalBodySpatialVelocityInWorld(*context_, body).rotational();
    const dm::SpatialAcceleration<double>& at_origin = of_bodies_[static_cast<std::size_t>(body.index())];
    const Eigen::Vector3d alpha = at_origin.rotational();
    Eigen::MatrixXd J(6, plant_.num_velocities());
    plant_.CalcJacobianSpatialVelocity(*context_, dm::JacobianWrtVariable::kV, body.body_frame(), point,
                                       plant_.world_frame(), plant_.world_frame(), &J);
    closed_chain::Place out{pose.translation() + arm, axes, Eigen::MatrixXd(6, J.cols()), {}};
    for (Eigen::Index k = 0; k < J.cols(); ++k) {
      const Eigen::VectorXd column = J.col(places_[static_cast<std::size_t>(k)]);
      out.jacobian.col(k) << column.tail<3>(), column.head<3>();
    }
    out.acceleration << at_origin.translational() + alpha.cross(arm) + w.cross(w.cross(arm)), alpha;
    return out;
  }

  Eigen::VectorXd forces() override {
    dm::MultibodyForces<double> applied(plant_);
    plant_.CalcForceElementsContribution(*context_, &applied);  // gravity
    const Eigen::VectorXd of_drake = plant_.CalcInverseDynamics(*context_, accelerations_, applied);
    Eigen::VectorXd out(of_drake.size());
    for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = of_drake(places_[static_cast<std::size_t>(k)]);
    return out;
  }

 private:
  static bool isCarried(const closed_chain::UrdfFile& file, int link) {
    return std::any_of(file.joints.begin(), file.joints.end(),
                       [link](const closed_chain::UrdfJoint& joint) { return joint.child == link; });
  }

  static dm::SpatialInertia<double> inertiaOf(const closed_chain::UrdfLink& link) {
    if (link.mass == 0) return dm::SpatialInertia<double>::Zero();
    const Eigen::Matrix3d& I = link.inertia;
    return dm::SpatialInertia<double>::MakeFromCentralInertia(
        link.mass, link.center, dm::RotationalInertia<double>(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
  }

  void add(const closed_chain::UrdfJoint& joint) {
    const dm::RigidBody<double>& parent = *bodies_[static_cast<std::size_t>(joint.parent)];
    const dm::RigidBody<double>& child = *bodies_[static_cast<std::size_t>(joint.child)];
    const drake::math::RigidTransform<double> origin(joint.origin);
    if (joint.coordinate < 0)
      plant_.WeldFrames(parent.body_frame(), child.body_frame(), origin);
    else if (joint.type == "prismatic")
      joints_.push_back(&plant_.AddJoint<dm::PrismaticJoint>(joint.name, parent, origin, child, {}, joint.axis));
    else
      joints_.push_back(&plant_.AddJoint<dm::RevoluteJoint>(joint.name, parent, origin, child, {}, joint.axis));
  }

  Eigen::VectorXd toDrake(const Eigen::VectorXd& of_file) const {
    Eigen::VectorXd out(of_file.size());
    for (Eigen::Index k = 0; k < out.size(); ++k) out(places_[static_cast<std::size_t>(k)]) = of_file(k);
    return out;
  }

  dm::MultibodyPlant<double> plant_{0.0};
  std::unique_ptr<drake::systems::Context<double>> context_;
  std::vector<const dm::RigidBody<double>*> bodies_;
  std::vector<const dm::Joint<double>*> joints_;
  std::vector<int> places_;  ///< of the file's coordinates, in Drake
  std::vector<dm::SpatialAcceleration<double>> of_bodies_;
  Eigen::VectorXd accelerations_;
};

}  // namespace

int main(int argc, char** argv) { return closed_chain::answerByUrdf<Drake>(argc, argv); }
