#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolverInterface.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "parts/engines/engine_machine.h"

namespace ursula::bullet_engine {

/// By default Bullet clips a constraint's impulses at 100 N·s, and speeds at 100.
inline constexpr double unlimited = 1e30;

class BulletWorld;

/// Multibodies of Bullet: each leg with three links, of which one has no mass, and the platform as a free base. Bullet
/// has a body's frame at its mass centre, with its principal axes. The platform's speeds are [ω; velocity of its mass
/// centre] in B.
class BulletMachine : public EngineMachine {
 public:
  explicit BulletMachine(const Manipulator& from);
  ~BulletMachine() override;

  /// Sets the legs and the platform to the motion with closed loops. Throws std::domain_error if a leg cannot reach.
  void set(const Motion<double>& motion, bool with_bias);
  /// Returns M u̇ + bias − weight on the leg's coordinates; `u_dot` are their accelerations.
  Vector3d forces(int leg, const Vector3d& u_dot);
  /// The same for the platform; `u_dot` is [α; acceleration of the mass centre].
  Vector6d platformForces(const Vector6d& u_dot);

  double coordinate(int leg, int j) const override { return legs_[static_cast<std::size_t>(leg)]->getJointPos(j); }
  double rate(int leg, int j) const override { return legs_[static_cast<std::size_t>(leg)]->getJointVel(j); }
  ChainBody platformBody() const override;
  double energy() override;
  void readMaps(PlacedTree& out) override;
  void addEffort(int leg, int j, double effort) override { body(leg).addJointTorque(j, effort); }
  void addWrench(const Vector6d& moment_and_force) override;
  void step(double h) override;

  const LegMotion& leg(int i) const { return states_[static_cast<std::size_t>(i)]; }
  btMultiBody& body(int leg) { return *legs_[static_cast<std::size_t>(leg)]; }
  btMultiBody& platform() { return *platform_; }
  btVector3 tip(int leg) const;            ///< in the frame of the leg's last link
  btVector3 platformPoint(int leg) const;  ///< in the platform's frame

  std::unique_ptr<BulletWorld> world;  ///< steps the machine; null while its loops are open

 private:
  struct Principal {
    Matrix3d axes;  ///< in the scenario's frame
    Vector3d moments;
  };
  static Principal principalOf(const Matrix3d& inertia);
  void addLeg(const Leg& leg);
  void place(btMultiBody& body);
  /// Returns M⁻¹ in the body's `size` coordinates from column `first` on, and sets `free` to the accelerations under
  /// gravity alone.
  Eigen::MatrixXd massInverse(btMultiBody& body, int first, int size, Eigen::VectorXd& free);
  double energyOf(btMultiBody& body);

  std::vector<std::unique_ptr<btMultiBody>> legs_;
  std::unique_ptr<btMultiBody> platform_;
  std::vector<LegChain> chains_;
  std::vector<std::array<Matrix3d, 2>> axes_;  ///< principal axes of the links
  Principal of_platform_;
  std::vector<LegMotion> states_;
  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
  btAlignedObjectArray<btQuaternion> scratch_q_;
};

/// A world that steps the machine with its loops closed by point-to-point constraints.
class BulletWorld {
 public:
  enum class Solver { gauss_seidel, dantzig };

  BulletWorld(BulletMachine& machine, Solver solver, int iterations, double erp, double cfm);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  /// Puts a motor on a leg's coordinate that brings it to the rate within the next step.
  void drive(int leg, int j, double rate);
  void step(double h) { world_->stepSimulation(h, 0); }
  /// Returns the motor's effort in the last step, of `h`; motors count in the order of `drive`.
  double effort(std::size_t motor, double h) const;

 private:
  void add(btMultiBody& body);
  void remove(btMultiBody& body);

  BulletMachine& machine_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  std::unique_ptr<btMLCPSolverInterface> direct_;
  std::unique_ptr<btMultiBodyConstraintSolver> solver_;
  std::unique_ptr<btMultiBodyDynamicsWorld> world_;
  btEmptyShape shape_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> balls_, motors_;
};

}  // namespace ursula::bullet_engine
