#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <memory>
#include <optional>

#include "parts/poses/direct_kinematics.h"
#include "parts/poses/direct_kinematics_parts.h"
#include "tests/support/motions.h"
#include "tests/support/vectors.h"

namespace ursula {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Size of the lengths in the plane equations, m.
inline double sizeOf(const MachineParameters<double>& model, const Vector3d& p) {
  double size = p.norm() + model.length;
  for (const LegModel<double>& leg : model.legs) size = std::max(size, p.norm() + model.length + leg.a.norm());
  return size;
}

/// The larger error of p in m and of Q in the Frobenius norm.
inline double poseError(const PlatformPose& pose, const Motion<double>& motion) {
  return std::max((pose.p - motion.p).norm(), (pose.Q - motion.Q).norm());
}

inline const PlatformPose* nearestPose(const PlatformPoses& poses, const Motion<double>& motion) {
  const PlatformPose* nearest = nullptr;
  for (const PlatformPose& pose : poses)
    if (nearest == nullptr || poseError(pose, motion) < poseError(*nearest, motion)) nearest = &pose;
  return nearest;
}

/// Errors from a motion to the actuated angles and back. The planes are solved with B, whose moments are divided by the
/// machine's length.
struct Conditioned {
  Vector6d phi;
  Eigen::JacobiSVD<Matrix6d> svd;
  double size = 0;
  double determinant = 0;

  Conditioned(const DirectKinematics& kinematics, const Motion<double>& motion) {
    Workspace<double> work;
    const MachineParameters<double>& model = kinematics.solver().machine();
    kinematics.solver().displacements(motion, work);
    phi = kinematics.solver().angles(work).phi;
    Matrix6d B;
    for (int i = 0; i < leg_count; ++i) {
      const LegState<double>& leg = work.legs[static_cast<std::size_t>(i)];
      B.row(i) << leg.Qb.cross(leg.x).transpose() / model.length, leg.x.transpose();
    }
    svd.compute(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
    determinant = B.determinant();
    size = sizeOf(model, motion.p);
  }

  double condition() const { return svd.singularValues()(0) / svd.singularValues()(5); }
  /// The limit: six planes with some ten roundings each, there and back, times the condition number.
  double limit() const { return 128 * eps * condition() * size; }
};

inline Motion<double> displaced(Motion<double> motion, const Vector3d& move, const Vector3d& turn) {
  motion.p += move;
  if (turn.norm() > 0) motion.Q = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * motion.Q;
  return motion;
}

/// The paper's machine with every geometric parameter changed at random by up to `spread`, relative for lengths, in m
/// for points.
inline ManipulatorParameters thrown(const ManipulatorParameters& paper, SeededDraws& dice, double spread) {
  ManipulatorParameters parameters = paper;
  for (Leg& leg : parameters.legs) {
    leg.base_point += dice.vector(3 * spread);
    leg.platform_point += dice.vector(3 * spread);
    leg.base_axis += dice.vector(5 * spread);
    leg.proximal.length *= 1 + dice.between(-2 * spread, 2 * spread);
    leg.distal.length *= 1 + dice.between(-2 * spread, 2 * spread);
    leg.knee = dice.between(0, 1) < 0.5 ? Knee::positive : Knee::negative;
  }
  return parameters;
}

/// A machine and a pose that it can take.
struct Case {
  std::shared_ptr<const DirectKinematics> kinematics;
  std::shared_ptr<const Manipulator> manipulator;
  Motion<double> motion;
};

inline Case feasibleCase(const Scenario& paper, SeededDraws& dice, double spread) {
  for (;;) {
    Case made;
    try {
      made.manipulator = std::make_shared<Manipulator>(thrown(paper.manipulator->parameters(), dice, spread));
      made.kinematics = std::make_shared<DirectKinematics>(*made.manipulator);
      made.motion = displaced(paper.trajectory->at(dice.between(0, paper.trajectory->duration())),
                              dice.vector(5 * spread), dice.vector(8 * spread));
      Workspace<double> work;
      made.kinematics->solver().displacements(made.motion, work);
      return made;
    } catch (const std::invalid_argument&) {  // the machine is impossible; draw again
    } catch (const PoseError&) {              // the pose is impossible
    }
  }
}

}  // namespace ursula
