#include <fmt/format.h>

#include "base/errors.h"
#include "model/pose_spline.h"
#include "model/scenario_keys.h"
#include "model/trajectories/trajectories.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {

std::unique_ptr<Trajectory> makeWaypoints(const std::vector<TimedPose>& points) {
  const PoseSplineOptions options{"waypoints", SplineEnds::at_rest, 2, 1e-3};
  return makePoseSpline(points, options, [](std::size_t i, const auto& key, const auto& value, const auto& bound) {
    const std::string place = key.empty() ? "" : fmt::format("[{}].{}", i + 1, key);
    throw InvalidParameter("trajectory.points" + place, value, bound);
  });
}

std::vector<ScenarioTable> waypointsKeys() {
  return {
      {"trajectory.waypoints",
       "[trajectory], kind = \"waypoints\"",
       "Through poses, at rest at both ends, four times continuously differentiable.",
       {kindKey(), tableKey("points", required_key, "at least two", "trajectory.waypoints.points", KeyType::tables)}},
      {"trajectory.waypoints.points",
       "points = [{ … }, …]",
       "The first at time 0; neighbours less than 170° apart.",
       {{"time", KeyType::number, "s", required_key, "increasing"},
        positionKey(),
        orientationKeys()[0],
        orientationKeys()[1]}}};
}

std::shared_ptr<const Trajectory> readWaypoints(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.waypoints"));
  if (!table.has("points")) table.missing("points", "an array of tables { time, position, orientation }");
  std::vector<TimedPose> poses;
  for (const TomlSection& point : table.sections("points")) {
    point.allowOnly(scenarioTable("trajectory.waypoints.points"));
    TimedPose pose;
    point.require("time", pose.time);
    point.require("position", pose.position);
    pose.orientation = readOrientation(point);
    poses.push_back(pose);
  }
  return makeWaypoints(poses);
}

}  // namespace ursula
