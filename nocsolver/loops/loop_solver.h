#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.h"
#include "model/motor_trajectory.h"
#include "nocsolver/loops/complement.h"

namespace ursula {

/// A body's pose, twist [ω; v of the mass centre] and twist rate, in world axes, SI.
struct BodyState {
  Eigen::Isometry3d displacement = Eigen::Isometry3d::Identity();  ///< from the reference pose
  Vector3d center = Vector3d::Zero();
  Vector6d twist = Vector6d::Zero(), twist_rate = Vector6d::Zero();
};

/// A body that may spin about its own line of symmetry, without effect on any effort. Nothing drives the spin, and it
/// began at rest, so that û·ω = 0 whatever turns beside it.
struct IdleBody {
  std::size_t body = 0;
  std::string name;
  Vector3d line = Vector3d::Zero();  ///< û at the reference pose; zero if a ball may turn about every line
};

/// The freedoms of a mechanism: as many motors as freedoms, idle ones aside.
struct LoopFreedoms {
  int free = 0;                          ///< freedoms that no motor drives
  int contradicted = 0;                  ///< motors whose coordinates the loops tie to those of others
  int freedoms = 0;                      ///< of the whole mechanism, without idle ones
  std::vector<std::string> free_joints;  ///< those that stay free
  std::vector<std::string> fighting;     ///< motors that fight each other
  std::vector<IdleBody> idle;

  std::vector<std::string> idleNames() const;
  /// Returns the idle body of this index, or null.
  const IdleBody* idleBody(std::size_t body) const;
};

/// A loop that is locked or loose at a pose, as if its links were in a line.
struct SingularLoop {
  std::string closing;              ///< the joint that closes it
  int line = 0;                     ///< of that joint in the file; 0 if unknown
  std::vector<std::string> joints;  ///< those of the tree in the loop
  loops::VectorXd motors;           ///< coordinates of the motors at a pose nearby that is not singular
  LoopFreedoms freedoms;            ///< there
};

/// How far a joint's coordinate was moved, rad or m; `share` counts lengths by the machine's.
struct JointMove {
  std::string joint;
  double by = 0, share = 0;
  bool slides = false;
};

/// The loops cannot follow the motors, or are too near to a singular pose.
class LoopError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One instant of a mechanism: where all its bodies are, how they move, and their complement.
struct LoopWork {
  loops::LoopPose pose;
  std::vector<BodyState> bodies;    ///< in the order of the mechanism
  loops::MatrixXd N;                ///< rates of the tree × motors: u = N q̇
  loops::VectorXd u, u_dot;         ///< rates of the tree's coordinates, and their derivatives
  std::vector<loops::MatrixXd> T;   ///< of each body, 6 × motors: t = T q̇, (32a)
  double reciprocal_condition = 1;  ///< of the passive rates
  double closing = 0;               ///< largest error of a closure that remains, relative to the machine's length
};

/// The natural orthogonal complement of a mechanism with any closed loops, from its closures: joint rates u = N q̇ of a
/// spanning tree by the closures' Jacobian, body twists t = T q̇ column by column as in (48) (Featherstone, Rigid Body
/// Dynamics Algorithms, ch. 8; Angeles and Lee 1988), and then (31) to (38) of the paper for any number of bodies
/// and motors. Redundant closures are allowed. Motors' coordinates are those of the model file. Immutable; threads
/// share it.
class LoopSolver {
 public:
  explicit LoopSolver(const Mechanism& mechanism);
  ~LoopSolver();
  LoopSolver(LoopSolver&&) noexcept;

  /// Returns the mechanism; where the reference pose is open, with the start at which its loops are closed.
  const Mechanism& mechanism() const;
  /// Returns the reference pose, its open closures closed by least movement. Throws LoopError if that fails.
  loops::LoopPose assembled() const;
  /// Returns how far that moved a body or closed a gap, relative to the machine's length.
  double assemblyGap() const;
  /// Returns which joint it moved the most.
  JointMove assemblyMove() const;
  /// Returns the motors' coordinates of a pose.
  loops::VectorXd motorCoordinates(const loops::LoopPose& pose) const;
  /// Returns the freedoms at a pose.
  LoopFreedoms freedoms(const loops::LoopPose& pose) const;

  /// Moves the motors of `pose` to q in steps small enough that the loops stay on their branch. Throws LoopError with
  /// the loop that cannot follow, or that says that a pose is singular. A watched path crosses no singular pose either:
  /// steps are halved until the determinant of the passive rates keeps its sign.
  void moveTo(const loops::VectorXd& q, loops::LoopPose& pose, bool watched = false) const;
  /// Returns the loop that makes a pose singular: at a pose nearby it holds more directions. Null if there is none.
  std::optional<SingularLoop> singularLoop(const loops::LoopPose& pose) const;

  /// Fills `work` for motors that move as `motion` says, from a pose near it. Throws LoopError.
  void kinematics(const MotorMotion& motion, const loops::LoopPose& near, LoopWork& work) const;
  /// Efforts of the motors, conjugate to q̇, by (37). Includes kinematics.
  loops::VectorXd inverseDynamics(const MotorMotion& motion, const loops::LoopPose& near, LoopWork& work) const;
  /// Accelerations of the motors under efforts, by (36); ignores those in `motion`.
  loops::VectorXd directDynamics(const MotorMotion& motion, const loops::VectorXd& efforts, const loops::LoopPose& near,
                                 LoopWork& work) const;
  /// I of (34), motors × motors. Needs the results of inverseDynamics.
  loops::MatrixXd inertia(const LoopWork& work) const;

  /// Returns the size of the terms that cancel in (37), for each motor: norms of forces and moments times those of T's
  /// columns, because products round by these in most frames. Needs the results of inverseDynamics.
  loops::VectorXd effortScale(const LoopWork& work) const;

  /// One coordinate of a joint with its rates, by the file's names and sense; a ball has four numbers and three rates.
  struct JointValue {
    std::string name;  ///< "knee_rad", "ball_w"
    double value = 0, rate = 0, acceleration = 0;
  };
  /// Returns the coordinates of all joints that are no motors, and of the hinges and slides among the file's closures.
  /// Needs kinematics.
  std::vector<JointValue> joints(const LoopWork& work) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Says which loop makes the file's pose singular, and what to do.
std::string singularWords(const Mechanism& mechanism, const SingularLoop& loop);

/// Moves a pose to where the motion starts. Throws LoopError, which says so.
void moveToStart(const LoopSolver& solver, const MotorTrajectory& trajectory, loops::LoopPose& pose);

/// A solver along a motion: it follows the loops once, from the assembly at the start. Immutable; threads share it.
class LoopMotion {
 public:
  /// Throws LoopError with the instant at which the loops cannot follow. Keeps pointers to its arguments.
  LoopMotion(const LoopSolver& solver, const MotorTrajectory& trajectory)
      : LoopMotion(solver, trajectory, solver.assembled()) {}
  /// Starts from the branch of `start`.
  LoopMotion(const LoopSolver& solver, const MotorTrajectory& trajectory, loops::LoopPose start);

  const LoopSolver& solver() const { return *solver_; }
  const MotorTrajectory& trajectory() const { return *trajectory_; }
  /// Returns a pose near that at t.
  const loops::LoopPose& near(double t) const;
  loops::VectorXd inverseDynamics(double t, LoopWork& work) const;

 private:
  void follow(double from, double to, int depth);

  const LoopSolver* solver_;
  const MotorTrajectory* trajectory_;
  std::vector<double> times_;
  std::vector<loops::LoopPose> poses_;
};

}  // namespace ursula
