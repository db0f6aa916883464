#pragma once

#include <vector>

#include "nocsolver/loops/loop_solver.h"

namespace ursula::mechanisms {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Velocity and acceleration of a body's point, in world axes.
struct PointState {
  Vector3d x, v, a;
};
/// Returns the motion of the point that lies at `reference` in the reference pose.
PointState pointOf(const BodyState& body, const Vector3d& reference);

/// One coordinate of a joint, along or about an axis at a point; in world axes.
struct Coordinate {
  std::size_t joint = 0;
  bool slides = false;
  Vector3d axis = Vector3d::Zero(), point = Vector3d::Zero();
  double value = 0;                   ///< by the file's zero, rad or m; of hinges and slides
  double rate = 0, acceleration = 0;  ///< of the right motion
  Eigen::RowVectorXd row;             ///< rate = row · q̇
};

/// One instant of the right motion.
struct Instant {
  MotorMotion motion;
  LoopWork work;
  std::vector<Coordinate> coordinates;  ///< of all joints, in their order

  /// Returns the part of a body's twist rate that the motors' accelerations do not make: Ṫ q̇.
  Vector6d biasOf(std::size_t body) const;
};

/// What a motor must overcome along each coordinate, beside the bodies' wrenches.
VectorXd loadsOf(const Mechanism& mechanism, const Instant& at);

/// Follows the motion to t.
Instant instantAt(const LoopMotion& motion, double t);

/// The file's own tree: its joints without those by which it closes loops, from the ground outwards.
class FileTree {
 public:
  explicit FileTree(const Mechanism& mechanism);

  /// Whether it holds every body and every motor.
  bool isWhole() const { return whole_; }
  /// Whether a joint is in the tree.
  bool holds(std::size_t joint) const { return sign_[joint] != 0; }
  /// Whether the child of a joint is nearer to the ground than its parent.
  bool isReversed(std::size_t joint) const { return sign_[joint] < 0; }
  /// Whether a joint is on the way from the ground to a body.
  bool isBefore(std::size_t joint, std::size_t body) const;
  /// J of a body in this tree, 6 × coordinates of the instant: t = J u; zero for coordinates that are cut.
  MatrixXd jacobian(const Instant& at, std::size_t body) const;
  /// The same for the twist [ω; v] of a body's point.
  MatrixXd jacobian(const Instant& at, std::size_t body, const Vector3d& point) const;
  /// u̇ of the tree's coordinates, zero for those that are cut.
  VectorXd accelerations(const Instant& at) const;
  /// The part of u̇ that the motors' accelerations do not make: b.
  VectorXd bias(const Instant& at) const;

 private:
  const Mechanism* mechanism_;
  std::vector<int> sign_;                          ///< of each joint: 1, −1 against its sense, 0 if it is cut
  std::vector<std::vector<std::size_t>> path_to_;  ///< joints from the ground to each body
  bool whole_ = false;
};

}  // namespace ursula::mechanisms
