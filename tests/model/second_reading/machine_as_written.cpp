#include <algorithm>
#include <array>
#include <string>

#include "tests/model/second_reading/written_numbers.h"

namespace ursula::written {
namespace {

/// A leg's keys: its own, or the defaults' if it lacks one.
class LegKeys {
 public:
  LegKeys(View own, View defaults) : own_(own), defaults_(defaults) {}

  View operator()(const char* key) const {
    const View found = own_[key];
    return found ? found : defaults_[key];
  }
  View operator()(const char* table, const char* key) const {
    const View found = own_[table][key];
    return found ? found : defaults_[table][key];
  }
  std::array<View, 2> tables(const char* table) const { return {own_[table], defaults_[table]}; }

 private:
  View own_, defaults_;
};

/// Reads a link; a carriage need not have a length.
Link linkOf(const LegKeys& keys, const char* name, bool carriage = false) {
  Link link;
  link.length = numberOr(keys(name, "length"), carriage ? 0 : none);
  link.mass = number(keys(name, "mass"));
  const View center = keys(name, "center_of_mass");
  const int line = carriage ? 1 : 2;
  if (center.is_array()) {
    link.off_line = numbers<3>(center);
    link.center_of_mass = link.off_line(line);
    link.off_line(line) = 0;
  } else {
    link.center_of_mass = number(center);
  }
  link.inertia = tensor(keys(name, "inertia"));
  return link;
}

LegKind kindOf(const std::string& text) {
  if (text == "UPS") return LegKind::UPS;
  if (text == "RUS") return LegKind::RUS;
  return text == "PUS" ? LegKind::PUS : LegKind::URS;
}

/// The names of a leg's coordinates, as in docs/scenario.md.
std::array<std::string, 3> coordinatesOf(LegKind kind) {
  if (kind == LegKind::UPS) return {"phi", "psi", "d"};
  if (kind == LegKind::PUS) return {"d", "psi", "theta"};
  return {"phi", "psi", "theta"};
}

/// The coordinates in the list, or the kind's default if there is no list.
std::array<bool, 3> actuatedOf(const View& list, LegKind kind) {
  if (!list) return {kind != LegKind::UPS, false, kind == LegKind::UPS};
  std::array<bool, 3> out = {false, false, false};
  const std::array<std::string, 3> names = coordinatesOf(kind);
  for (std::size_t i = 0; list.is_array() && i < list.as_array()->size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (list[i].value_or(std::string()) == names[j]) out[j] = true;
  return out;
}

/// Reads friction by the coordinate's name, for URS legs also by the joint's. Defaults for coordinates that the leg
/// lacks are ignored. A leg's own table precedes the defaults', whichever name it uses.
JointFriction frictionOf(const LegKeys& keys, const char* name, LegKind kind) {
  const std::array<std::string, 3> has = coordinatesOf(kind);
  const auto of = [&](const char* coordinate, const char* joint) {
    if (std::find(has.begin(), has.end(), coordinate) == has.end()) return 0.0;
    for (const View& table : keys.tables(name))
      for (const char* key : {coordinate, kind == LegKind::URS ? joint : nullptr})
        if (key != nullptr && table[key]) return number(table[key]);
    return 0.0;
  };
  JointFriction friction;
  friction.phi = of("phi", "actuated");
  friction.psi = of("psi", "universal");
  friction.theta = of("theta", "knee");
  friction.d = of("d", nullptr);
  return friction;
}

Leg legOf(const LegKeys& keys) {
  Leg leg;
  leg.kind = kindOf(keys("kind").value_or(std::string("URS")));
  leg.actuated = actuatedOf(keys("actuated"), leg.kind);
  leg.base_point = numbers<3>(keys("base_point"));
  leg.base_axis = numbers<3>(keys("base_axis"));
  leg.platform_point = numbers<3>(keys("platform_point"));
  leg.proximal = linkOf(keys, "proximal", leg.kind == LegKind::PUS);
  leg.distal = linkOf(keys, "distal");
  leg.knee = keys("knee").value_or(std::string("positive")) == "negative" ? Knee::negative : Knee::positive;
  leg.friction = frictionOf(keys, "friction", leg.kind);
  static_cast<JointFriction&>(leg.coulomb) = frictionOf(keys, "coulomb", leg.kind);
  leg.spins = keys("spin").value_or(std::string("held")) == "free";
  // A free spin has no moment about its line.
  if (leg.spins) leg.distal.inertia(2, 2) = 0;
  if (leg.spins && leg.kind == LegKind::UPS) leg.proximal.inertia(2, 2) = 0;
  const std::array<std::string, 3> has = coordinatesOf(leg.kind);
  for (std::size_t j = 0; j < 3; ++j)
    if (leg.actuated[j])
      leg.rotor_inertia.on(rowOf(leg.kind).coordinates[j]) = numberOr(keys("rotor_inertia", has[j].c_str()), 0);
  leg.coulomb.smoothing_speed = leg.coulomb.sliding_speed = numberOr(keys("coulomb", "smoothing_speed"), 0.01);
  return leg;
}

}  // namespace

ManipulatorParameters machineOf(const View& table) {
  ManipulatorParameters machine;
  machine.gravity = vectorOr(table["gravity"], {0, 0, -9.81});
  machine.platform.mass = number(table["platform"]["mass"]);
  machine.platform.center_of_mass = numbers<3>(table["platform"]["center_of_mass"]);
  machine.platform.inertia = tensor(table["platform"]["inertia"]);
  machine.legs.clear();
  for (std::size_t i = 0; i < sizeOf(table["leg"]); ++i)
    machine.legs.push_back(legOf({table["leg"][i], table["leg_defaults"]}));
  return machine;
}

}  // namespace ursula::written
