#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/trajectories/trajectories.h"

// Common parts of the trajectories through given poses (waypoints, samples).

namespace ursula {

/// Throws the caller's error for pose `i` (0-based) and one of the keys time, position, orientation.
using RefusePose =
    std::function<void(std::size_t i, const std::string& key, const std::string& value, const std::string& bound)>;

/// How the spline starts and ends: at rest, or with the derivatives of the quintic through the six outermost poses.
enum class SplineEnds { at_rest, free };

/// A trajectory through all poses. It refuses fewer than `at_least` poses and times that do not start at 0 or do not
/// increase. It refuses quaternions off unit length by more than `unit_within`, and ambiguous rotations between
/// orientations. `refuse` must throw.
struct PoseSplineOptions {
  std::string kind;
  SplineEnds ends = SplineEnds::at_rest;
  std::size_t at_least = 2;
  double unit_within = 1e-3;
};
std::unique_ptr<Trajectory> makePoseSpline(const std::vector<TimedPose>& poses, const PoseSplineOptions& options,
                                           const RefusePose& refuse);

/// Refuses non-finite quaternions and those off unit length by more than `within`.
void requireUnit(const Eigen::Vector4d& orientation, double within,
                 const std::function<void(const std::string& value, const std::string& bound)>& refuse);

}  // namespace ursula
