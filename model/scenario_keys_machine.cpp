// The scenario's tables that describe the machine.

#include "model/leg_kind.h"
#include "model/scenario_keys.h"

namespace ursula {
namespace {

std::vector<std::string> kindNames() {
  std::vector<std::string> out;
  for (const LegKindRow& row : leg_kinds) out.emplace_back(row.name);
  return out;
}

ScenarioTable manipulator() {
  return {"manipulator",
          "[manipulator]",
          "",
          {{"gravity", KeyType::vector, "m/s²", "[0.0, 0.0, -9.81]", "g, in B"},
           choiceKey("legs", "\"with_mass\"",
                     "`massless` takes all links without mass and inertia, whatever their tables say: the platform's "
                     "dynamics alone",
                     {"with_mass", "massless"}),
           tableKey("platform", required_key, "the platform with all that it carries", "manipulator.platform"),
           tableKey("leg_defaults", no_default, "what all legs share; takes every key of a leg", "manipulator.leg"),
           tableKey("leg", required_key, "three to six, in leg order", "manipulator.leg", KeyType::tables)}};
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
  return {"manipulator.leg",
          "[[manipulator.leg]]",
          "One of three to six; also `[manipulator.leg_defaults]`, whose keys a leg may override one by one. Required "
          "keys must stand in one of the two.",
          {choiceKey("kind", "\"URS\"",
                     "the joints from base to platform, where each leg ends in a spherical one: URS (the paper's), UPS "
                     "(telescopic), RUS (crank and rod), PUS (carriage and rod)",
                     kindNames()),
           {"actuated",
            KeyType::choices,
            "",
            no_default,
            "the coordinates that a motor drives, six in all the legs; by default the first of URS, RUS (phi, psi, "
            "theta) and PUS (d, psi, theta), and the last of UPS (phi, psi, d)",
            {},
            {"phi", "psi", "theta", "d"}},
           {"base_point", KeyType::vector, "m", required_key, "aᵢ: the base joint A, in B"},
           {"base_axis", KeyType::vector, "", required_key,
            "uᵢ: the axis of the first joint, in B; normalised on reading. φ is positive about −uᵢ, d of PUS along it"},
           {"platform_point", KeyType::vector, "m", required_key, "bᵢ: the platform joint B, in M"},
           tableKey("proximal", required_key, "the link from A to the knee R; the cylinder of UPS, the carriage of PUS",
                    "manipulator.leg.link"),
           tableKey("distal", required_key, "the link from the knee R to B; the rod", "manipulator.leg.link"),
           choiceKey("knee", "\"positive\"",
                     "which of the two bends of the knee: sign of sin θ (URS), sin ψ (RUS), cos θ (PUS)",
                     {"positive", "negative"}),
           tableKey("friction", no_default, "viscous friction in the joints", "manipulator.leg.friction"),
           tableKey("coulomb", no_default, "Coulomb friction in the joints, smoothed", "manipulator.leg.coulomb"),
           tableKey("rotor_inertia", no_default, "of what the motors turn", "manipulator.leg.rotor_inertia"),
           choiceKey("spin", "\"held\"",
                     "whether a universal joint holds the rod (of UPS cylinder and rod) about its own line, or a ball "
                     "lets it spin, which then it does not: S–P–S for UPS, R–S–S for RUS, P–S–S for PUS. `free` needs "
                     "equal moments across the line, no products of inertia and a mass centre on it",
                     {"held", "free"})}};
}

ScenarioTable link() {
  return {
      "manipulator.leg.link",
      "proximal = { … }, distal = { … }",
      "A link of a leg: from its first joint along its length to the second.",
      {{"length", KeyType::number, "m", required_key,
        "l of the proximal, s of the distal link; of the carriage of PUS for drawing only, and not required",
        above_zero},
       {"mass", KeyType::number, "kg", required_key, "0 of a link without mass, whose inertia is zero", not_negative},
       {"center_of_mass", KeyType::center, "m", required_key,
        "distance along the link from its first end, of a rod of UPS from the end within the cylinder; or from "
        "there `[x, y, z]` in the link's frame (of a carriage of PUS [x̂, û, ẑ])"},
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
  return {
      "manipulator.leg.rotor_inertia", "rotor_inertia = { … }",
      "The inertia j of what the motor turns, in the energy ½ j q̇² of the coordinate q that it drives. Behind a gear "
      "of ratio n, j is n² times the inertia of the rotor itself. The motor's effort has the further term j q̈.",
      std::move(keys)};
}

}  // namespace

std::vector<ScenarioTable> machineTables() {
  return {manipulator(), platform(), leg(), link(), friction(), coulomb(), rotorInertia()};
}

}  // namespace ursula
