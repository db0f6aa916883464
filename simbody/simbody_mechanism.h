#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "model/mechanism.h"
#include "model/motor_trajectory.h"

namespace ursula {

/// A mechanism with any closed loops in Simbody, built from raw parameters alone, with a spanning tree of its own
/// choice. It never uses the solver: coordinates come from Newton's method, rates and accelerations from Simbody's
/// constraint Jacobian and bias. Closures may be redundant.
///
/// Coordinates of motors are those of the file's joints, in the order of mechanism.motors(); efforts are conjugate to
/// their rates. Loads of a ball or free joint act on the components of its rate: angular ones in the axes of the
/// child's frame, linear ones in those of the parent's. A body that closures and motors leave free to spin
/// about its own line, as a rod between two balls, has no absolute spin about it. Not thread-safe; each thread needs
/// its own.
class SimbodyMechanism {
 public:
  enum class Tree {
    other,    ///< cuts other joints than the file's closures wherever it can
    of_file,  ///< cuts the file's closures
  };

  /// The pose as displacement from the reference pose, x = D x₀; twist [ω; v of the mass centre] and its rate.
  struct BodyState {
    Eigen::Isometry3d displacement = Eigen::Isometry3d::Identity();
    Vector6d twist = Vector6d::Zero(), twist_rate = Vector6d::Zero();
  };

  /// The largest error over the cut joints; angles count by the machine's length.
  struct Closure {
    double position = 0;  ///< m
    double velocity = 0;  ///< m/s
  };

  struct Energy {
    double kinetic = 0;    ///< with rotors, J
    double potential = 0;  ///< of gravity and springs, J
  };

  /// Throws std::domain_error for what Simbody cannot hold: an inertia that no body has, a spring on a ball, or
  /// closures that cannot be closed from the reference pose.
  explicit SimbodyMechanism(const Mechanism& mechanism, Tree tree = Tree::other);
  ~SimbodyMechanism();
  SimbodyMechanism(SimbodyMechanism&&) noexcept;
  SimbodyMechanism& operator=(SimbodyMechanism&&) noexcept;

  // --- state ---

  /// Moves the motors to motion.q. It continues the last placed configuration, and takes smaller steps where Newton's
  /// method does not converge at once. Throws std::domain_error with the name of a joint if the loops cannot follow;
  /// the last placed configuration stays then.
  void place(const MotorMotion& motion);
  /// Returns to the file's reference pose at rest, closed by least movement.
  void reset();
  /// Returns how far the most open joint is open at the file's reference pose, m; angles count by the machine's length.
  double gap() const;
  /// Returns the states of mechanism.bodies() at the last placed or computed accelerations.
  std::vector<BodyState> bodies() const;
  Closure closure() const;
  Energy energy() const;
  /// Returns the power that damping and friction take, W.
  double losses() const;
  Eigen::VectorXd motorCoordinates() const;
  Eigen::VectorXd motorRates() const;

  // --- dynamics ---

  /// Returns the motors' efforts for the last placed or computed accelerations: Simbody's residual forces projected on
  /// the motors' rates with its constraint Jacobian.
  Eigen::VectorXd inverseDynamics() const;
  /// Computes all accelerations under these efforts, and returns those of the motors. By Simbody's
  /// realize(Acceleration), which handles redundant constraints itself. If the mechanism has rotors, idle spins or tips
  /// without inertia, that cannot hold them; then by elimination with Simbody's mass matrix, Jacobian and bias.
  Eigen::VectorXd accelerations(const Eigen::VectorXd& efforts);
  /// Computes the same by elimination in any case.
  Eigen::VectorXd accelerationsByElimination(const Eigen::VectorXd& efforts);
  /// How the open tree moves at the last placed or computed accelerations: u = N q̇ and q̇ = S u for its speeds u.
  struct OpenTree {
    Eigen::MatrixXd N, S;
    Eigen::VectorXd u_dot;
  };
  OpenTree openTree() const;
  /// Returns Simbody's residual forces on these speeds for accelerations u̇, less all loads.
  Eigen::VectorXd residual(const Eigen::VectorXd& u_dot) const;
  /// Returns whether accelerations() uses Simbody's realize(Acceleration).
  bool usesSimbodysOwn() const;

  // --- as a system of ordinary differential equations: y = [q, u] ---

  int stateSize() const;
  std::vector<double> state() const;
  /// Sets time and state.
  void setState(double t, const double* y);
  /// Computes ẏ at (t, y) under `efforts`: where Simbody's own accelerations serve, with its M⁻¹ and the same
  /// multipliers by fewer sweeps of the tree. Where these are beyond all numbers, ẏ is not finite.
  void derivative(double t, const double* y, const Eigen::VectorXd& efforts, double* y_dot);
  /// Moves the state onto the closures by least movement, positions and rates. Throws std::domain_error if it cannot.
  void project();

  /// Returns in words which joints are cut.
  std::string tree() const;
  /// Returns the indices of the cut joints in mechanism.joints(), increasing; without free joints, which close nothing.
  std::vector<std::size_t> cutJoints() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ursula
