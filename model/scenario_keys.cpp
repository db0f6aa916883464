#include "model/scenario_keys.h"

#include <algorithm>
#include <stdexcept>

namespace ursula {
namespace {

constexpr double least_positive = std::numeric_limits<double>::denorm_min();
constexpr KeyBound positive{"> 0", least_positive};
constexpr KeyBound not_negative{">= 0", 0};
constexpr KeyBound not_zero{"not 0", -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), false};
constexpr const char* required = "!";
constexpr const char* none = "";

ScenarioTable document() {
  return {"",
          "(the top of the file)",
          "A machine, its motion and how that is judged. SI units throughout; B is the base's frame, M the platform's.",
          {{"name", KeyType::string, "", required, "results go to results/NAME; a name that a folder can have"},
           {"manipulator", KeyType::table, "", required, "the machine", {}, {}, "manipulator"},
           {"trajectory", KeyType::table, "", required, "the commanded motion of the platform", {}, {}, "trajectory"},
           {"load", KeyType::table, "", none, "what acts on the platform from outside", {}, {}, "load"},
           {"simulation", KeyType::table, "", none, "how finely it is looked at and integrated", {}, {}, "simulation"},
           {"acceptance", KeyType::table, "", none, "limits of your own", {}, {}, "acceptance"}}};
}

ScenarioTable manipulator() {
  return {"manipulator",
          "[manipulator]",
          "",
          {{"gravity", KeyType::vector, "m/s²", "[0.0, 0.0, -9.81]", "g, in B"},
           {"platform",
            KeyType::table,
            "",
            required,
            "the platform with all that it carries",
            {},
            {},
            "manipulator.platform"},
           {"leg_defaults",
            KeyType::table,
            "",
            none,
            "what all legs share; takes every key of a leg",
            {},
            {},
            "manipulator.leg"},
           {"leg", KeyType::tables, "", required, "exactly six, in leg order", {}, {}, "manipulator.leg"}}};
}

ScenarioTable platform() {
  return {"manipulator.platform",
          "[manipulator.platform]",
          "",
          {{"mass", KeyType::number, "kg", required, "m", positive},
           {"center_of_mass", KeyType::vector, "m", required, "ρ: from P, the platform's origin, in M"},
           {"inertia", KeyType::inertia, "kg·m²", required,
            "about the mass centre, in M: `[xx, yy, zz]` or `[xx, yy, zz, xy, xz, yz]`, entries of the tensor"}}};
}

ScenarioTable leg() {
  return {"manipulator.leg",
          "[[manipulator.leg]]",
          "One of six; also `[manipulator.leg_defaults]`, whose keys a leg may override one by one. Required keys must "
          "stand in one of the two.",
          {{"base_point", KeyType::vector, "m", required, "aᵢ: the base joint A, in B"},
           {"base_axis", KeyType::vector, "", required,
            "uᵢ: the motor's axis, in B; normalised on reading. φ is positive about −uᵢ"},
           {"platform_point", KeyType::vector, "m", required, "bᵢ: the platform joint B, in M"},
           {"proximal", KeyType::table, "", required, "the link from A to the knee R", {}, {}, "manipulator.leg.link"},
           {"distal", KeyType::table, "", required, "the link from the knee R to B", {}, {}, "manipulator.leg.link"},
           {"knee",
            KeyType::choice,
            "",
            "\"positive\"",
            "sign of sin θ: which of the two bends of the knee",
            {},
            {"positive", "negative"}},
           {"friction", KeyType::table, "", none, "viscous friction in the joints", {}, {}, "manipulator.leg.friction"},
           {"coulomb",
            KeyType::table,
            "",
            none,
            "Coulomb friction in the joints, smoothed",
            {},
            {},
            "manipulator.leg.coulomb"}}};
}

ScenarioTable link() {
  return {"manipulator.leg.link",
          "proximal = { … }, distal = { … }",
          "A link of a leg: from its first joint along its length to the second.",
          {{"length", KeyType::number, "m", required, "l of the proximal, s of the distal link", positive},
           {"mass", KeyType::number, "kg", required, "", positive},
           {"center_of_mass", KeyType::number, "m", required, "distance along the link from its first joint"},
           {"inertia", KeyType::inertia, "kg·m²", required,
            "about the mass centre, in the link's frame, whose third axis is along the link"}}};
}

ScenarioTable friction() {
  const auto key = [](const char* name, const char* meaning) {
    return ScenarioKey{name, KeyType::number, "N·m·s/rad", "0.0", meaning, not_negative};
  };
  return {"manipulator.leg.friction",
          "friction = { … }",
          "Viscous: a moment −c q̇ on a joint coordinate q.",
          {key("actuated", "on φ, the motor's"), key("universal", "on ψ, between proximal link and its motor"),
           key("knee", "on θ")}};
}

ScenarioTable coulomb() {
  const auto key = [](const char* name, const char* meaning) {
    return ScenarioKey{name, KeyType::number, "N·m", "0.0", meaning, not_negative};
  };
  return {"manipulator.leg.coulomb",
          "coulomb = { … }",
          "A moment −c tanh(q̇ / smoothing_speed) on a joint coordinate q.",
          {key("actuated", "on φ, the motor's"),
           key("universal", "on ψ"),
           key("knee", "on θ"),
           {"smoothing_speed", KeyType::number, "rad/s", "0.01", "at which 76 % of the friction acts", positive}}};
}

const std::vector<std::string> kinds = {"helix", "waypoints", "samples", "hold"};

ScenarioKey kindKey() { return {"kind", KeyType::choice, "", required, "what the motion is made of", {}, kinds}; }

ScenarioTable trajectory() {
  return {"trajectory", "[trajectory]", "Its other keys depend on `kind`, see below.", {kindKey()}};
}

ScenarioKey angle(const char* name, const char* fallback, const char* meaning) {
  return {name, KeyType::number, "rad", fallback, meaning};
}

ScenarioKey inDegrees(const char* name, const char* meaning) { return {name, KeyType::number, "°", none, meaning}; }

ScenarioTable helix() {
  return {
      "trajectory.helix",
      "[trajectory], kind = \"helix\"",
      "P on a helix about the z axis of B, the platform along with its triad. The helix' angle is a quintic in time "
      "between the values, rates and accelerations given at both ends.",
      {kindKey(),
       {"duration", KeyType::number, "s", required, "t_f", positive},
       {"radius", KeyType::number, "m", required, "a", positive},
       {"pitch", KeyType::number, "m/rad", required, "b: the rise for an angle of 1 rad", not_zero},
       angle("start_angle", required, "β₀"),
       inDegrees("start_angle_deg", "instead of `start_angle`"),
       angle("end_angle", required, "β_f"),
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
  return {"orientation", KeyType::quaternion, "", required,
          "unit quaternion `[w, x, y, z]` of M in B, either sign; w, the scalar, comes first"};
}

ScenarioKey rollPitchYaw() {
  return {"rpy_deg", KeyType::vector, "°", none, "`[roll, pitch, yaw]` instead of `orientation`, see Angles"};
}

ScenarioKey position() { return {"position", KeyType::vector, "m", required, "of P, in B"}; }

ScenarioTable waypoints() {
  return {
      "trajectory.waypoints",
      "[trajectory], kind = \"waypoints\"",
      "Through poses, at rest at both ends, four times continuously differentiable.",
      {kindKey(), {"points", KeyType::tables, "", required, "at least two", {}, {}, "trajectory.waypoints.points"}}};
}

ScenarioTable points() {
  return {"trajectory.waypoints.points",
          "points = [{ … }, …]",
          "The first at time 0; neighbours less than 170° apart.",
          {{"time", KeyType::number, "s", required, "increasing"}, position(), orientation(), rollPitchYaw()}};
}

ScenarioTable samples() {
  return {"trajectory.samples",
          "[trajectory], kind = \"samples\"",
          "Through the poses of a motion sampled densely.",
          {kindKey(),
           {"file", KeyType::string, "", required,
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
           {"duration", KeyType::number, "s", required, "", positive}}};
}

ScenarioKey force(const char* meaning) { return {"force", KeyType::vector, "N", "[0.0, 0.0, 0.0]", meaning}; }

ScenarioKey moment() {
  return {"moment", KeyType::vector, "N·m", "[0.0, 0.0, 0.0]", "a couple, on top of what the force's arm gives"};
}

ScenarioTable load() {
  return {
      "load",
      "[load]",
      "A force and a moment on the platform: constant (`force`, `moment`), or over time by one of `file` and `table`, "
      "quintic between the rows and constant beyond them.",
      {force("constant"),
       moment(),
       {"point", KeyType::vector, "m", "[0.0, 0.0, 0.0]", "where the force acts, in M; zero is P"},
       {"frame", KeyType::choice, "", "\"base\"", "in which force and moment are given", {}, {"base", "platform"}},
       {"file", KeyType::string, "", none,
        "a CSV with `t_s`, `f_{x,y,z}_N`, `m_{x,y,z}_Nm`; a relative path is taken from the scenario's folder"},
       {"table", KeyType::tables, "", none, "rows over time, at least two", {}, {}, "load.table"}}};
}

ScenarioTable loadTable() {
  return {"load.table",
          "table = [{ … }, …]",
          "",
          {{"time", KeyType::number, "s", required, "increasing"}, force("at that time"), moment()}};
}

ScenarioTable simulation() {
  return {"simulation",
          "[simulation]",
          "Every key has a default, recorded in the results.",
          {{"samples",
            KeyType::integer,
            "",
            "301",
            "instants judged and written, from 0 to t_f",
            {"an integer from 2 to 1000000", 2, 1e6}},
           {"integrator",
            KeyType::choice,
            "",
            "\"rkf78\"",
            "of the replays: rkf78 is Boost.Odeint's, rk_merson Simbody's",
            {},
            {"rkf78", "rk_merson"}},
           {"tolerance",
            KeyType::number,
            "",
            "1e-14",
            "of the integrator, absolute and relative",
            {"a number from 1e-15 to 1e-3", 1e-15, 1e-3}}}};
}

ScenarioTable acceptance() {
  return {
      "acceptance",
      "[acceptance]",
      "Limits of your own in place of derived ones: `\"torque.pointwise\" = 1e-6`, in the check's unit, > 0, by the "
      "names that `summary.json` lists. And:",
      {{"torque",
        KeyType::limits,
        "",
        none,
        "a tolerance for efforts, as `--rtol` and `--atol`; both are added",
        {},
        {},
        "acceptance.torque"}}};
}

ScenarioTable tolerance() {
  return {"acceptance.torque",
          "torque = { … }",
          "At least one of the two.",
          {{"relative", KeyType::number, "", none, "of the largest effort of the motion", positive},
           {"absolute", KeyType::number, "N·m or N", none, "", positive}}};
}

}  // namespace

std::vector<std::string> ScenarioTable::names() const {
  std::vector<std::string> out;
  for (const ScenarioKey& each : keys) out.emplace_back(each.name);
  return out;
}

const ScenarioKey& ScenarioTable::key(const std::string& wanted) const {
  for (const ScenarioKey& each : keys)
    if (wanted == each.name) return each;
  throw std::out_of_range("no key '" + wanted + "' in the scenario's table '" + name + "'");
}

const std::vector<ScenarioTable>& scenarioTables() {
  static const std::vector<ScenarioTable> tables = {
      document(),  manipulator(), platform(), leg(),  link(), friction(),  coulomb(),    trajectory(), helix(),
      waypoints(), points(),      samples(),  hold(), load(), loadTable(), simulation(), acceptance(), tolerance()};
  return tables;
}

const ScenarioTable& scenarioTable(const std::string& name) {
  for (const ScenarioTable& each : scenarioTables())
    if (name == each.name) return each;
  throw std::out_of_range("no table '" + name + "' in a scenario");
}

}  // namespace ursula
