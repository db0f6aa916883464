#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/trajectories/trajectories.h"

// What the trajectories through given poses (waypoints, samples) have in common.

namespace ursula {

/// Throws the caller's own error for pose `i` (0-based) and one of the keys time, position, orientation.
using RefusePose =
    std::function<void(std::size_t i, const std::string& key, const std::string& value, const std::string& bound)>;

/// How the spline starts and ends: at rest, or with the derivatives of the quintic through the six outermost poses.
enum class SplineEnds { at_rest, free };

/// A trajectory through all poses. Refuses (and relies on `refuse` to throw) fewer than `at_least` poses, times that do
/// not start at 0 or do not increase, quaternions off unit length by more than `unit_within`, and orientations between
/// which the way round is ambiguous.
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
