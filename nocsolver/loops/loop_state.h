#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "base/scalar.h"
#include "nocsolver/loops/loop_tree.h"

namespace ursula::loops {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A configuration of the tree: displacements from the reference pose, rad or m, by rate; balls have quaternions.
struct LoopPose {
  VectorXd q;
  std::vector<Eigen::Quaterniond> balls;  ///< by element; identity for the others
};

/// Position and motion of one element's frame; in world axes.
struct FrameState {
  Matrix3d R = Matrix3d::Identity();                        ///< from the reference pose
  Vector3d d = Vector3d::Zero();                            ///< x = R x₀ + d
  Vector3d axis = Vector3d::Zero();                         ///< of its coordinate, if that is no ball
  Vector3d point = Vector3d::Zero();                        ///< its centre
  Matrix3d before = Matrix3d::Identity();                   ///< R of the frame before it
  Vector3d omega = Vector3d::Zero(), v = Vector3d::Zero();  ///< angular velocity; velocity of the centre
  Vector3d alpha = Vector3d::Zero(), a = Vector3d::Zero();  ///< accelerations
};

/// Velocity and acceleration of a point, or of a frame.
struct PointMotion {
  Vector3d x = Vector3d::Zero(), v = Vector3d::Zero(), a = Vector3d::Zero();
  Vector3d omega = Vector3d::Zero(), alpha = Vector3d::Zero();
};

/// The frames of a tree at one instant. The ground has index −1.
class Frames {
 public:
  explicit Frames(const LoopTree& tree) : tree_(&tree), frames_(tree.elements.size()) {}

  /// Sets positions.
  void place(const LoopPose& pose);
  /// Sets velocities and accelerations of the placed frames, for rates u and their derivatives.
  void move(const VectorXd& u, const VectorXd& u_dot);

  const FrameState& at(int element) const;
  Eigen::Isometry3d displacement(int element) const;
  /// Returns the motion of the point with position `reference` in the reference pose.
  PointMotion pointOf(int element, const Vector3d& reference) const;
  /// Adds `sign` times the columns of a frame's angular velocity and of its point's velocity, 3 × rates each.
  void addColumns(int element, const Vector3d& point, double sign, Eigen::Ref<MatrixXd> angular,
                  Eigen::Ref<MatrixXd> linear) const;

 private:
  const LoopTree* tree_;
  std::vector<FrameState> frames_;
  FrameState ground_;
};

/// Moves a configuration by rates times time.
void advance(const LoopTree& tree, const VectorXd& step, LoopPose& pose);

}  // namespace ursula::loops
