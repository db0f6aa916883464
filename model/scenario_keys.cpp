#include "model/scenario_keys.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/leg_kind.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {
namespace {

ScenarioTable document() {
  return {
      "",
      "(the top of the file)",
      "A machine, its motion and how that is judged. SI units throughout; B is the base's frame, M the platform's.",
      {{"name", KeyType::string, "", required_key, "results go to results/NAME; a name that a folder can have"},
       {"manipulator", KeyType::table, "", required_key, "the machine", {}, {}, "manipulator"},
       {"trajectory", KeyType::table, "", required_key, "the commanded motion of the platform", {}, {}, "trajectory"},
       {"load", KeyType::table, "", no_default, "what acts on the platform from outside", {}, {}, "load"},
       {"simulation",
        KeyType::table,
        "",
        no_default,
        "how finely it is looked at and integrated",
        {},
        {},
        "simulation"},
       {"acceptance", KeyType::table, "", no_default, "limits of your own", {}, {}, "acceptance"}}};
}

ScenarioTable manipulator() {
  return {"manipulator",
          "[manipulator]",
          "",
          {{"gravity", KeyType::vector, "m/s²", "[0.0, 0.0, -9.81]", "g, in B"},
           {"platform",
            KeyType::table,
            "",
            required_key,
            "the platform with all that it carries",
            {},
            {},
            "manipulator.platform"},
           {"leg_defaults",
            KeyType::table,
            "",
            no_default,
            "what all legs share; takes every key of a leg",
            {},
            {},
            "manipulator.leg"},
           {"leg", KeyType::tables, "", required_key, "three to six, in leg order", {}, {}, "manipulator.leg"}}};
}

ScenarioTable platform() {
  return {"manipulator.platform",
          "[manipulator.platform]",
          "",
          {{"mass", KeyType::number, "kg", required_key, "m", above_zero},
           {"center_of_mass", KeyType::vector, "m", required_key, "ρ: from P, the platform's origin, in M"},
           {"inertia", KeyType::inertia, "kg·m²", required_key,
            "about the mass centre, in M: `[xx, yy, zz]` or `[xx, yy, zz, xy, xz, yz]`, entries of the tensor"}}};
}

ScenarioTable leg() {
  return {
      "manipulator.leg",
      "[[manipulator.leg]]",
      "One of three to six; also `[manipulator.leg_defaults]`, whose keys a leg may override one by one. Required keys "
      "must "
      "stand in one of the two.",
      {{"kind",
        KeyType::choice,
        "",
        "\"URS\"",
        "the joints from base to platform, where each leg ends in a spherical one: URS (the paper's), UPS "
        "(telescopic), "
        "RUS (crank and rod), PUS (carriage and rod)",
        {},
        {"URS", "UPS", "RUS", "PUS"}},
       {"actuated",
        KeyType::choices,
        "",
        no_default,
        "the coordinates that a motor drives, six in all the legs; by default the first of URS, RUS (phi, psi, theta) "
        "and PUS (d, psi, theta), and the last of UPS (phi, psi, d)",
        {},
        {"phi", "psi", "theta", "d"}},
       {"base_point", KeyType::vector, "m", required_key, "aᵢ: the base joint A, in B"},
       {"base_axis", KeyType::vector, "", required_key,
        "uᵢ: the axis of the first joint, in B; normalised on reading. φ is positive about −uᵢ, d of PUS along it"},
       {"platform_point", KeyType::vector, "m", required_key, "bᵢ: the platform joint B, in M"},
       {"proximal",
        KeyType::table,
        "",
        required_key,
        "the link from A to the knee R; the cylinder of UPS, the carriage of PUS",
        {},
        {},
        "manipulator.leg.link"},
       {"distal",
        KeyType::table,
        "",
        required_key,
        "the link from the knee R to B; the rod",
        {},
        {},
        "manipulator.leg.link"},
       {"knee",
        KeyType::choice,
        "",
        "\"positive\"",
        "which of the two bends of the knee: sign of sin θ (URS), sin ψ (RUS), cos θ (PUS)",
        {},
        {"positive", "negative"}},
       {"friction",
        KeyType::table,
        "",
        no_default,
        "viscous friction in the joints",
        {},
        {},
        "manipulator.leg.friction"},
       {"coulomb",
        KeyType::table,
        "",
        no_default,
        "Coulomb friction in the joints, smoothed",
        {},
        {},
        "manipulator.leg.coulomb"},
       {"rotor_inertia",
        KeyType::table,
        "",
        no_default,
        "of what the motors turn",
        {},
        {},
        "manipulator.leg.rotor_inertia"},
       {"spin",
        KeyType::choice,
        "",
        "\"held\"",
        "whether a universal joint holds the rod (of UPS cylinder and rod) about its own line, or a ball lets it spin, "
        "which then it does not: S–P–S for UPS, R–S–S for RUS, P–S–S for PUS. `free` needs equal moments across the "
        "line, no products of inertia and a mass centre on it",
        {},
        {"held", "free"}}}};
}

ScenarioTable link() {
  return {
      "manipulator.leg.link",
      "proximal = { … }, distal = { … }",
      "A link of a leg: from its first joint along its length to the second.",
      {{"length", KeyType::number, "m", required_key,
        "l of the proximal, s of the distal link; of the carriage of PUS for drawing only, and not required",
        above_zero},
       {"mass", KeyType::number, "kg", required_key, "", above_zero},
       {"center_of_mass", KeyType::center, "m", required_key,
        "distance along the link from its first end, of a rod of UPS from the end within the cylinder; or from there "
        "`[x, y, z]` in the link's frame (of a carriage of PUS [x̂, û, ẑ])"},
       {"inertia", KeyType::inertia, "kg·m²", required_key,
        "about the mass centre, in the link's frame, whose third axis is along the link; of a thin rod zero about "
        "it"}}};
}

std::vector<ScenarioKey> perCoordinate(const char* turning, const char* sliding) {
  const auto key = [](const char* name, const char* unit, const char* meaning) {
    return ScenarioKey{name, KeyType::number, unit, "0.0", meaning, not_negative};
  };
  return {key("phi", turning, "on φ"),     key("psi", turning, "on ψ"),          key("theta", turning, "on θ"),
          key("d", sliding, "on d"),       key("actuated", turning, "φ of URS"), key("universal", turning, "ψ of URS"),
          key("knee", turning, "θ of URS")};
}

ScenarioTable friction() {
  return {"manipulator.leg.friction", "friction = { … }",
          "Viscous: a moment (on d a force) −c q̇ on a joint coordinate q that the leg has.",
          perCoordinate("N·m·s/rad", "N·s/m")};
}

ScenarioTable coulomb() {
  ScenarioTable out = {"manipulator.leg.coulomb", "coulomb = { … }",
                       "A moment (on d a force) −c tanh(q̇ / smoothing_speed) on a joint coordinate q that the leg has.",
                       perCoordinate("N·m", "N")};
  out.keys.push_back(
      {"smoothing_speed", KeyType::number, "rad/s, m/s", "0.01", "at which 76 % of the friction acts", above_zero});
  return out;
}

ScenarioTable rotorInertia() {
  std::vector<ScenarioKey> keys = perCoordinate("kg·m²", "kg");
  keys.resize(coordinate_count);
  return {"manipulator.leg.rotor_inertia", "rotor_inertia = { … }",
          "The inertia j of what the motor turns, in the energy ½ j q̇² of the coordinate q that it drives. Behind a "
          "gear of "
          "ratio n, j is n² times the inertia of the rotor itself. The motor's effort has the further term j q̈.",
          std::move(keys)};
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
       {"file", KeyType::string, "", no_default,
        "a CSV with `t_s`, `f_{x,y,z}_N`, `m_{x,y,z}_Nm`; a relative path is taken from the scenario's folder"},
       {"table", KeyType::tables, "", no_default, "rows over time, at least two", {}, {}, "load.table"}}};
}

ScenarioTable loadTable() {
  return {"load.table",
          "table = [{ … }, …]",
          "",
          {{"time", KeyType::number, "s", required_key, "increasing"}, force("at that time"), moment()}};
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
        no_default,
        "a tolerance for efforts, as `--rtol` and `--atol`; both are added",
        {},
        {},
        "acceptance.torque"}}};
}

ScenarioTable tolerance() {
  return {"acceptance.torque",
          "torque = { … }",
          "At least one of the two.",
          {{"relative", KeyType::number, "", no_default, "of the largest effort of the motion", above_zero},
           {"absolute", KeyType::number, "N·m or N", no_default, "", above_zero}}};
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
  static const std::vector<ScenarioTable> tables = [] {
    std::vector<ScenarioTable> all = {document(), manipulator(), platform(), leg(),
                                      link(),     friction(),    coulomb(),  rotorInertia()};
    for (ScenarioTable& each : motionTables()) all.push_back(std::move(each));
    for (ScenarioTable each : {load(), loadTable(), simulation(), acceptance(), tolerance()})
      all.push_back(std::move(each));
    return all;
  }();
  return tables;
}

std::string otherFrictionName(const std::string& key) {
  constexpr std::pair<const char*, const char*> names[] = {
      {"phi", "actuated"}, {"psi", "universal"}, {"theta", "knee"}};
  for (const auto& [one, other] : names) {
    if (key == one) return other;
    if (key == other) return one;
  }
  return "";
}

const ScenarioTable& scenarioTable(const std::string& name) {
  for (const ScenarioTable& each : scenarioTables())
    if (name == each.name) return each;
  throw std::out_of_range("no table '" + name + "' in a scenario");
}

}  // namespace ursula
