#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/scenario.h"
#include "parts/identify/signals.h"
#include "parts/poses/direct_kinematics.h"

namespace ursula::identification {

/// Computes one machine's platform motion from the motors' motion, and the efforts for it.
class MotorChain {
 public:
  explicit MotorChain(const Manipulator& machine) : kinematics_(machine) {}

  /// Returns the motion at the pose that continues `from`, in smaller steps if Newton's method needs them. Returns none
  /// without such a pose.
  std::optional<Motion<double>> follow(const MeasuredState& state, const Motion<double>& from) const;
  Vector6d efforts(const Motion<double>& motion, const Vector6d& load) const;
  /// Returns the driven coordinates and their rates.
  std::pair<Vector6d, Vector6d> driven(const Motion<double>& motion) const;

 private:
  std::optional<PlatformPose> pose(const Vector6d& driven, const PlatformPose& from) const;

  DirectKinematics kinematics_;
  mutable Workspace<double> work_;
};

/// Returns the motion of measured poses; q need not be of length 1.
Motion<double> motionOfPoses(const MeasuredState& state);

/// Returns the motion at `t` that is off a pose by P's displacement, m, and a Rodrigues vector in the platform's frame.
Motion<double> motionAbout(const Motion<double>& pose, const MeasuredState& off, double t);

/// Returns a motion of the scenario that is near these driven coordinates and leads to them. Returns none if no motion
/// of the scenario leads to them.
std::optional<Motion<double>> firstMotion(const Scenario& scenario, const MotorChain& chain,
                                          const MeasuredState& state);

}  // namespace ursula::identification
