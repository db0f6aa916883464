#pragma once

#include <memory>
#include <string>

#include "parts/engines/mechanism_closing.h"
#include "parts/engines/recipe.h"

namespace ursula {

/// An engine's own speeds of a mechanism, and the joints that they do not hold by themselves.
struct BuiltTree {
  std::unique_ptr<SpeedsOfWelds> speeds;
  std::vector<std::size_t> cut;
};
/// Builds the mechanism from raw parameters alone. Throws std::domain_error or std::runtime_error, in the engine's
/// words, for one that the engine cannot hold. Keeps its arguments.
using BuildTree = BuiltTree(const Mechanism& mechanism, const WeldedMechanism& welded);

/// Maximal coordinates: six speeds of each moving body, and all joints as constraints, Gᵀλ + Sᵀτ = M a + h − loads;
/// redundant constraints make λ ambiguous, never τ.
BuildTree buildMaximal;
/// A spanning tree without MuJoCo's own constraints, because these are soft; mj_rne gives the forces on its speeds.
BuildTree buildMujoco;

/// What a user with closed loops asks of an engine. Not thread-safe.
class MechanismCalls {
 public:
  MechanismCalls() = default;
  virtual ~MechanismCalls() = default;
  MechanismCalls(const MechanismCalls&) = delete;
  MechanismCalls& operator=(const MechanismCalls&) = delete;

  /// Returns the motors' efforts in N·m or N; continues the last pose. Throws std::domain_error with a joint's name if
  /// the loops cannot follow, and with a reason if the engine knows no such recipe for this machine.
  virtual Eigen::VectorXd efforts(Recipe recipe, const MotorMotion& motion) = 0;
  /// Returns the largest gap of a loop as last placed, m; angles count by the machine's length.
  virtual double gap() const = 0;
  virtual std::vector<std::size_t> cutJoints() const = 0;  ///< indices into mechanism.joints()

  // --- in time, with the engine's own closures and steps ---
  struct Moved {
    Eigen::VectorXd q;              ///< of the motors
    Vector3d p = Vector3d::Zero();  ///< of the output body's mass centre, m
    double gap = 0;                 ///< m
    double energy = 0, power = 0;   ///< kinetic and of weight, J; of friction, damping and springs, W
  };
  /// Returns the settings of the loops' rigidity, the default first; empty if the engine moves no mechanism.
  virtual std::vector<Rigidity> rigidities() const { return {}; }
  /// Begins at the motion with closed loops. Throws std::domain_error with the reason if the engine cannot.
  virtual Moved start(const Rigidity& rigidity, const MotorMotion& motion);
  /// Moves by one step under efforts. Throws std::runtime_error if the engine gives up.
  virtual void step(const Eigen::VectorXd& efforts);
  virtual Moved moved() const;
};

/// A mechanism with any closed loops in an engine's tree: its kinematics and Jacobians close the loops by Newton's
/// method, and the complement of the closures takes its forces to the motors. Bodies may be without mass.
class ClosedMechanism : public MechanismCalls {
 public:
  /// Throws what `build` throws, std::domain_error for a spring on a ball, and for loops that do not close near the
  /// reference pose.
  ClosedMechanism(const Mechanism& mechanism, BuildTree* build);

  /// Returns efforts by the exact recipe.
  Eigen::VectorXd inverseDynamics(const MotorMotion& motion) { return efforts(Recipe::exact, motion); }
  Eigen::VectorXd efforts(Recipe recipe, const MotorMotion& motion) override;
  double gap() const override { return closing_.gap(); }
  std::vector<std::size_t> cutJoints() const override;
  std::vector<Rigidity> rigidities() const override { return tree_.speeds->rigidities(); }
  Moved start(const Rigidity& rigidity, const MotorMotion& motion) override;
  void step(const Eigen::VectorXd& efforts) override;
  Moved moved() const override;

 private:
  Eigen::VectorXd missingWeights() const;
  double energy() const;

  Mechanism mechanism_;
  WeldedMechanism welded_;
  BuiltTree tree_;
  MechanismClosing closing_;
};

}  // namespace ursula
