#pragma once

#include <memory>
#include <vector>

#include "base/csv.h"
#include "model/trajectory.h"

// The motions beside the helix. All are twice continuously differentiable in SO(3) × R³ over [0, duration] and extend
// smoothly beyond; ω and ω̇ are exact derivatives of the orientation returned.

namespace ursula {

/// A pose of the platform at an instant, in B.
struct TimedPose {
  double time = 0;                                         ///< s
  Vector3d position = Vector3d::Zero();                    ///< of P, m
  Eigen::Vector4d orientation = Eigen::Vector4d::UnitX();  ///< [w, x, y, z] of M in B; either sign
};

/// Stays where it is. The quaternion may be off unit length by 1e-3 and is normalised; duration > 0.
/// Throws InvalidParameter (places `trajectory.…`).
std::unique_ptr<Trajectory> makeHold(const Vector3d& position, const Eigen::Vector4d& orientation, double duration);

/// Through at least two poses, the first at time 0, at rest (zero twist and twist rate) at both ends; four times
/// continuously differentiable. Quaternions as for makeHold; neighbours less than 170° apart, so that the way round is
/// clear. Throws InvalidParameter (places `trajectory.points[n].…`, 1-based).
std::unique_ptr<Trajectory> makeWaypoints(const std::vector<TimedPose>& points);

/// Through at least six poses of a motion sampled densely, the first at time 0; four times continuously differentiable.
/// It starts and ends as the quintic through the six outermost poses does, so any motion that is a quintic comes back
/// exactly, and a smooth one with an error of O(h⁴) in the accelerations. Quaternions are unit within 1e-6.
/// Throws InvalidParameter (places `trajectory.samples[n].…`, 1-based).
std::unique_ptr<Trajectory> makeSamples(const std::vector<TimedPose>& samples);

/// The same from columns t_s, p_{x,y,z}_m, q_{w,x,y,z} of a table; other columns are ignored, since velocities and
/// accelerations have to be derivatives of the poses. Throws CsvError with the file and line.
std::unique_ptr<Trajectory> makeSamples(const CsvTable& table);

}  // namespace ursula
