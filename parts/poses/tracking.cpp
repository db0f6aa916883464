#include "parts/poses/tracking.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace ursula::poses {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Returns the error in the driven coordinates; angles are reduced to the nearest turn.
Vector6d missing(const Noc<double>& solver, const NocWorkspace<double>& work, const Vector6d& driven) {
  const Vector6d found = solver.angles(work).driven(solver.machine().motors);
  Vector6d out;
  for (int m = 0; m < motor_count; ++m) {
    const double difference = driven(m) - found(m);
    out(m) = solver.machine().motors[m].slides() ? difference : std::remainder(difference, 2 * pi);
  }
  return out;
}

/// Returns the largest driven coordinate in metres.
double sizeOf(const Noc<double>& solver, const Vector6d& driven) {
  double largest = 0;
  for (int m = 0; m < motor_count; ++m)
    largest =
        std::max(largest, std::abs(driven(m)) * (solver.machine().motors[m].slides() ? 1 : solver.machine().length));
  return largest;
}

void move(const Vector6d& twist, Motion<double>& motion) {
  const Vector3d turn = twist.head<3>();
  const double angle = turn.norm();
  if (angle > 0)
    motion.Q = (Eigen::AngleAxisd(angle, turn / angle) * Eigen::Quaterniond(motion.Q)).normalized().toRotationMatrix();
  motion.p += twist.tail<3>();
}

PlatformPose poseAt(const Noc<double>& solver, const Motion<double>& motion, const NocWorkspace<double>& work,
                    double residual) {
  PlatformPose pose;
  pose.p = motion.p;
  pose.Q = motion.Q;
  const Eigen::Quaterniond q(motion.Q);
  pose.q << q.w(), q.x(), q.y(), q.z();
  if (pose.q(0) < 0) pose.q = -pose.q;
  pose.residual = residual;
  pose.assembles = pose.front = true;
  const JointVariables<double> joints = solver.angles(work);
  for (int i = 0; i < solver.machine().legs_in_all; ++i)
    pose.legs[i] = {work.legs[i].AB.norm(), true, true, joints.psi(i), joints.theta(i)};
  return pose;
}

}  // namespace

/// Under Kantorovich's conditions each Newton step is at most half of the previous one.
std::optional<PlatformPose> track(const Noc<double>& solver, const Vector6d& driven, const PlatformPose& from) {
  Motion<double> motion;
  motion.p = from.p;
  motion.Q = from.Q;
  NocWorkspace<double> work;
  double previous = std::numeric_limits<double>::infinity();
  int first_sign = 0;
  try {
    for (int step = 0; step < std::numeric_limits<double>::digits; ++step) {
      solver.displacements(motion, work);
      solver.jacobians(motion, work);
      const int sign = work.B_transposed.determinant() > 0 ? 1 : -1;
      if (step == 0) first_sign = sign;
      if (sign != first_sign) return std::nullopt;
      const Vector6d left = missing(solver, work, driven);
      const double error = sizeOf(solver, left), size = motion.p.norm() + solver.machine().length;
      if (error <= 4 * eps * size) return poseAt(solver, motion, work, error);
      const Vector6d twist = solver.platformShaping(work) * left;
      const double moved = twist.tail<3>().norm() + solver.machine().length * twist.head<3>().norm();
      if (!(moved <= previous / 2))
        return moved <= 64 * eps * size ? std::optional(poseAt(solver, motion, work, error)) : std::nullopt;
      previous = moved;
      move(twist, motion);
    }
  } catch (const PoseError&) {
  }
  return std::nullopt;
}

}  // namespace ursula::poses
