#include "model/scenario_keys_motion.h"

namespace ursula {
namespace {

const std::vector<std::string> kinds = {"helix", "waypoints", "samples", "hold"};

ScenarioKey kindKey() { return {"kind", KeyType::choice, "", required_key, "what the motion is made of", {}, kinds}; }

ScenarioTable trajectory() {
  return {"trajectory", "[trajectory]", "Its other keys depend on `kind`, see below.", {kindKey()}};
}

ScenarioKey angle(const char* name, const char* fallback, const char* meaning) {
  return {name, KeyType::number, "rad", fallback, meaning};
}

ScenarioKey inDegrees(const char* name, const char* meaning) {
  return {name, KeyType::number, "°", no_default, meaning};
}

ScenarioTable helix() {
  return {
      "trajectory.helix",
      "[trajectory], kind = \"helix\"",
      "P on a helix about the z axis of B, the platform along with its triad. The helix' angle is a quintic in time "
      "between the values, rates and accelerations given at both ends.",
      {kindKey(),
       {"duration", KeyType::number, "s", required_key, "t_f", positive},
       {"radius", KeyType::number, "m", required_key, "a", positive},
       {"pitch", KeyType::number, "m/rad", required_key, "b: the rise for an angle of 1 rad", not_zero},
       angle("start_angle", required_key, "β₀"),
       inDegrees("start_angle_deg", "instead of `start_angle`"),
       angle("end_angle", required_key, "β_f"),
       inDegrees("end_angle_deg", "instead of `end_angle`"),
       angle("phase", "0.0", "ω"),
       inDegrees("phase_deg", "instead of `phase`"),
       angle("height_phase", "0.0", "ω̄: adds its own times b to the height"),
       inDegrees("height_phase_deg", "instead of `height_phase`"),
       {"start_rate", KeyType::number, "rad/s", "0.0", "at t = 0"},
       {"end_rate", KeyType::number, "rad/s", "0.0", "at t_f"},
       {"start_acceleration", KeyType::number, "rad/s²", "0.0", "at t = 0"},
       {"end_acceleration", KeyType::number, "rad/s²", "0.0", "at t_f"}}};
}

ScenarioKey orientation() {
  return {"orientation", KeyType::quaternion, "", required_key,
          "unit quaternion `[w, x, y, z]` of M in B, either sign; w, the scalar, comes first"};
}

ScenarioKey rollPitchYaw() {
  return {"rpy_deg", KeyType::vector, "°", no_default, "`[roll, pitch, yaw]` instead of `orientation`, see Angles"};
}

ScenarioKey position() { return {"position", KeyType::vector, "m", required_key, "of P, in B"}; }

ScenarioTable waypoints() {
  return {"trajectory.waypoints",
          "[trajectory], kind = \"waypoints\"",
          "Through poses, at rest at both ends, four times continuously differentiable.",
          {kindKey(),
           {"points", KeyType::tables, "", required_key, "at least two", {}, {}, "trajectory.waypoints.points"}}};
}

ScenarioTable points() {
  return {"trajectory.waypoints.points",
          "points = [{ … }, …]",
          "The first at time 0; neighbours less than 170° apart.",
          {{"time", KeyType::number, "s", required_key, "increasing"}, position(), orientation(), rollPitchYaw()}};
}

ScenarioTable samples() {
  return {"trajectory.samples",
          "[trajectory], kind = \"samples\"",
          "Through the poses of a motion sampled densely.",
          {kindKey(),
           {"file", KeyType::string, "", required_key,
            "a CSV with `t_s`, `p_{x,y,z}_m`, `q_{w,x,y,z}`, at least six rows; a relative path is taken from the "
            "scenario's folder"}}};
}

ScenarioTable hold() {
  return {"trajectory.hold",
          "[trajectory], kind = \"hold\"",
          "Stays where it is.",
          {kindKey(),
           position(),
           orientation(),
           rollPitchYaw(),
           {"duration", KeyType::number, "s", required_key, "", positive}}};
}

}  // namespace

std::vector<ScenarioTable> motionTables() { return {trajectory(), helix(), waypoints(), points(), samples(), hold()}; }

}  // namespace ursula
