#pragma once

#include <memory>
#include <vector>

#include "base/csv.h"
#include "model/trajectory.h"

// Motions beside the helix. All are twice continuously differentiable in SO(3) × R³ over [0, duration] and extend
// smoothly beyond; ω and ω̇ are exact derivatives of the returned orientation.

namespace ursula {

/// A pose of the platform at an instant, in B.
struct TimedPose {
  double time = 0;                                         ///< s
  Vector3d position = Vector3d::Zero();                    ///< of P, m
  Eigen::Vector4d orientation = Eigen::Vector4d::UnitX();  ///< [w, x, y, z] of M in B; either sign
};

/// Returns a constant pose. The quaternion is normalised and may be off unit length by 1e-3; duration > 0. Throws
/// InvalidParameter (places `trajectory.…`).
std::unique_ptr<Trajectory> makeHold(const Vector3d& position, const Eigen::Vector4d& orientation, double duration);

/// Returns a motion through at least two poses, the first at time 0, at rest (zero twist and twist rate) at both ends.
/// It is four times continuously differentiable. Quaternions are as for makeHold; neighbours are less than 170° apart,
/// so the rotation is unique. Throws InvalidParameter (places `trajectory.points[n].…`, 1-based).
std::unique_ptr<Trajectory> makeWaypoints(const std::vector<TimedPose>& points);

/// Returns a motion through at least six dense samples, the first at time 0; four times continuously differentiable.
/// Its end derivatives are those of the quintic through the six outermost poses. So it reproduces any quintic exactly,
/// and a smooth motion with an error of O(h⁴) in the accelerations. Quaternions are unit within 1e-6. Throws
/// InvalidParameter (places `trajectory.samples[n].…`, 1-based).
std::unique_ptr<Trajectory> makeSamples(const std::vector<TimedPose>& samples);

/// Returns the same from columns t_s, p_{x,y,z}_m, q_{w,x,y,z} of a table. Other columns are ignored, because
/// velocities and accelerations must be derivatives of the poses. Throws CsvError with the file and line.
std::unique_ptr<Trajectory> makeSamples(const CsvTable& table);

}  // namespace ursula
