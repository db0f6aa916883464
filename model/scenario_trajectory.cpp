#include "base/shown_text.h"
#include "model/scenario_orientation.h"
#include "model/scenario_sections.h"
#include "model/trajectories.h"

namespace ursula {
namespace {

/// `orientation`, a quaternion, or `rpy_deg`.
Eigen::Vector4d readOrientation(const TomlSection& table) {
  Eigen::Vector4d orientation;
  Vector3d angles;
  const bool by_angles = table.read("rpy_deg", angles);
  if (by_angles && table.has("orientation"))
    table.fail("rpy_deg", "given beside 'orientation', expected one of the two");
  if (by_angles) return quaternionOf(angles);
  if (!table.read("orientation", orientation))
    table.missing("orientation", "an array of 4 numbers, or 'rpy_deg', an array of 3");
  return orientation;
}

std::shared_ptr<const Trajectory> readHelix(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.helix"));
  HelixParameters helix;
  table.require("duration", helix.duration);
  table.require("radius", helix.radius);
  table.require("pitch", helix.pitch);
  table.requireAngle("start_angle", helix.start_angle);
  table.requireAngle("end_angle", helix.end_angle);
  table.readAngle("phase", helix.phase);
  table.readAngle("height_phase", helix.height_phase);
  table.read("start_rate", helix.start_rate);
  table.read("end_rate", helix.end_rate);
  table.read("start_acceleration", helix.start_acceleration);
  table.read("end_acceleration", helix.end_acceleration);
  return makeHelix(helix);
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

std::shared_ptr<const Trajectory> readSamples(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.samples"));
  return makeSamples(readCsvBeside(table, "file"));
}

std::shared_ptr<const Trajectory> readHold(const TomlSection& table) {
  table.allowOnly(scenarioTable("trajectory.hold"));
  TimedPose pose;
  double duration = 0;
  table.require("position", pose.position);
  pose.orientation = readOrientation(table);
  table.require("duration", duration);
  return makeHold(pose.position, pose.orientation, duration);
}

}  // namespace

CsvTable readCsvBeside(const TomlSection& table, const std::string& key) {
  std::string name;
  table.require(key, name);
  try {
    requirePath(name);
  } catch (const TextRefusal& refusal) {
    table.fail(key, refusal.what());
  }
  const std::filesystem::path file = std::filesystem::path(table.file()).parent_path() / name;
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error))
    table.fail(key, "'" + shownPath(file.string()) + "', expected a CSV file");
  return readCsv(file);
}

std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory) {
  const auto kind = trajectory.readChoice(scenarioTable("trajectory").key("kind"));
  if (!kind) trajectory.missing("kind", "'helix', 'waypoints', 'samples' or 'hold'");
  switch (*kind) {
    case 0:
      return readHelix(trajectory);
    case 1:
      return readWaypoints(trajectory);
    case 2:
      return readSamples(trajectory);
    default:
      return readHold(trajectory);
  }
}

}  // namespace ursula
