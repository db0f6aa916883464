#include "model/scenario_sections.h"
#include "model/trajectories.h"

namespace ursula {
namespace {

std::shared_ptr<const Trajectory> readHelix(const TomlSection& table) {
  table.allowOnly({"kind", "duration", "radius", "pitch", "start_angle", "end_angle", "phase", "height_phase",
                   "start_rate", "end_rate", "start_acceleration", "end_acceleration"});
  HelixParameters helix;
  table.require("duration", helix.duration);
  table.require("radius", helix.radius);
  table.require("pitch", helix.pitch);
  table.require("start_angle", helix.start_angle);
  table.require("end_angle", helix.end_angle);
  table.read("phase", helix.phase);
  table.read("height_phase", helix.height_phase);
  table.read("start_rate", helix.start_rate);
  table.read("end_rate", helix.end_rate);
  table.read("start_acceleration", helix.start_acceleration);
  table.read("end_acceleration", helix.end_acceleration);
  return makeHelix(helix);
}

std::shared_ptr<const Trajectory> readWaypoints(const TomlSection& table) {
  table.allowOnly({"kind", "points"});
  if (!table.has("points")) table.missing("points", "an array of tables { time, position, orientation }");
  std::vector<TimedPose> poses;
  for (const TomlSection& point : table.sections("points")) {
    point.allowOnly({"time", "position", "orientation"});
    TimedPose pose;
    point.require("time", pose.time);
    point.require("position", pose.position);
    point.require("orientation", pose.orientation);
    poses.push_back(pose);
  }
  return makeWaypoints(poses);
}

std::shared_ptr<const Trajectory> readSamples(const TomlSection& table) {
  table.allowOnly({"kind", "file"});
  return makeSamples(readCsvBeside(table, "file"));
}

std::shared_ptr<const Trajectory> readHold(const TomlSection& table) {
  table.allowOnly({"kind", "position", "orientation", "duration"});
  TimedPose pose;
  double duration = 0;
  table.require("position", pose.position);
  table.require("orientation", pose.orientation);
  table.require("duration", duration);
  return makeHold(pose.position, pose.orientation, duration);
}

}  // namespace

CsvTable readCsvBeside(const TomlSection& table, const std::string& key) {
  std::string name;
  table.require(key, name);
  const std::filesystem::path file = std::filesystem::path(table.file()).parent_path() / name;
  std::error_code error;
  if (name.empty() || !std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error))
    table.fail(key, "'" + file.string() + "', expected a CSV file");
  return readCsv(file);
}

std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory) {
  const auto kind = trajectory.readChoice("kind", {"helix", "waypoints", "samples", "hold"});
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
