#include "model/trajectories/trajectory_kinds.h"

#include <algorithm>

#include "model/quaternions.h"
#include "model/scenario_keys.h"
#include "model/scenario_sections.h"

namespace ursula {

const TrajectoryKind* trajectoryKind(const std::string& name) {
  const auto* found = std::find_if(trajectory_kinds.begin(), trajectory_kinds.end(),
                                   [&](const TrajectoryKind& kind) { return name == kind.name; });
  return found == trajectory_kinds.end() ? nullptr : found;
}

ScenarioKey kindKey() {
  std::vector<std::string> names;
  for (const TrajectoryKind& kind : trajectory_kinds) names.emplace_back(kind.name);
  return {"kind", KeyType::choice, "", required_key, "what the motion is made of", {}, std::move(names)};
}

ScenarioKey positionKey() { return {"position", KeyType::vector, "m", required_key, "of P, in B"}; }

std::array<ScenarioKey, 2> orientationKeys() {
  return {{{"orientation", KeyType::quaternion, "", required_key,
            "unit quaternion `[w, x, y, z]` of M in B, either sign; w, the scalar, comes first"},
           {"rpy_deg", KeyType::vector, "°", no_default, "`[roll, pitch, yaw]` instead of `orientation`, see Angles"}}};
}

Eigen::Vector4d readOrientation(const TomlSection& table) {
  Eigen::Vector4d orientation;
  Vector3d angles;
  const bool by_angles = table.read("rpy_deg", angles);
  if (by_angles && table.has("orientation"))
    table.fail("rpy_deg", "given beside 'orientation', expected one of the two");
  if (by_angles) return quaternionOf(angles);
  if (const toml::node* given = table.table().get("orientation"); given != nullptr && given->is_array())
    if (given->as_array()->size() == 3)
      table.fail("orientation", "an array of 3, expected an array of 4 numbers, did you mean 'rpy_deg'?");
  if (!table.read("orientation", orientation))
    table.missing("orientation", "an array of 4 numbers, or 'rpy_deg', an array of 3");
  return orientation;
}

std::vector<ScenarioTable> motionTables() {
  std::vector<ScenarioTable> out = {
      {"trajectory", "[trajectory]", "Its other keys depend on `kind`, see below.", {kindKey()}}};
  for (const TrajectoryKind& kind : trajectory_kinds)
    for (ScenarioTable& table : kind.keys()) out.push_back(std::move(table));
  return out;
}

std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory) {
  const auto kind = trajectory.readChoice(scenarioTable("trajectory").key("kind"));
  if (!kind) trajectory.missing("kind", "'helix', 'waypoints', 'samples' or 'hold'");
  return trajectory_kinds[*kind].read(trajectory);
}

}  // namespace ursula
