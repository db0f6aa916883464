#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/scenario.h"
#include "nocsolver/poses/direct_kinematics.h"

namespace ursula::identification {

/// Value, rate and acceleration of what a log has of the motion: six driven coordinates, or p and q.
struct MeasuredState {
  Eigen::VectorXd value, rate, acceleration;
};

/// The platform's motion from that of the motors, and the efforts that it needs, of one machine.
class MotorChain {
 public:
  explicit MotorChain(const Manipulator& machine) : kinematics_(machine) {}

  /// The motion at the pose that continues `from`; in smaller steps where Newton needs them. None where there is none.
  std::optional<Motion<double>> follow(const MeasuredState& state, const Motion<double>& from) const;
  Vector6d efforts(const Motion<double>& motion, const Vector6d& load) const;
  /// Displacements and rates of what the motors drive.
  std::pair<Vector6d, Vector6d> driven(const Motion<double>& motion) const;

 private:
  std::optional<PlatformPose> pose(const Vector6d& driven, const PlatformPose& from) const;

  DirectKinematics kinematics_;
  mutable Workspace<double> work_;
};

/// The motion of poses that were measured; q need not be of length 1.
Motion<double> motionOfPoses(const MeasuredState& state);

/// A motion of the scenario's that is near these driven coordinates and leads to them; none where they cannot be
/// reached from any.
std::optional<Motion<double>> firstMotion(const Scenario& scenario, const MotorChain& chain,
                                          const MeasuredState& state);

}  // namespace ursula::identification
