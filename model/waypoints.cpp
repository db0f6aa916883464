#include <fmt/format.h>

#include "base/errors.h"
#include "model/pose_spline.h"
#include "model/trajectories.h"

namespace ursula {

std::unique_ptr<Trajectory> makeWaypoints(const std::vector<TimedPose>& points) {
  const PoseSplineOptions options{"waypoints", SplineEnds::at_rest, 2, 1e-3};
  return makePoseSpline(points, options, [](std::size_t i, const auto& key, const auto& value, const auto& bound) {
    const std::string place = key.empty() ? "" : fmt::format("[{}].{}", i + 1, key);
    throw InvalidParameter("trajectory.points" + place, value, bound);
  });
}

}  // namespace ursula
