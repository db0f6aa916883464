#include "model/scenario_sections.h"

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

}  // namespace

std::shared_ptr<const Trajectory> readTrajectory(const TomlSection& trajectory) {
  const auto kind = trajectory.readChoice("kind", {"helix"});
  if (!kind) trajectory.missing("kind", "'helix', 'waypoints', 'samples' or 'hold'");
  return readHelix(trajectory);
}

}  // namespace ursula
