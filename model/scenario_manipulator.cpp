#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "model/scenario_sections.h"

namespace ursula {
namespace {

/// Names of friction coefficients: the coordinates, and the older names for the paper's legs.
struct FrictionKey {
  const char* name;
  Coordinate coordinate;
  bool of_urs_alone;
};
constexpr std::array<FrictionKey, 7> friction_keys = {{{"phi", Coordinate::phi, false},
                                                       {"psi", Coordinate::psi, false},
                                                       {"theta", Coordinate::theta, false},
                                                       {"d", Coordinate::d, false},
                                                       {"actuated", Coordinate::phi, true},
                                                       {"universal", Coordinate::psi, true},
                                                       {"knee", Coordinate::theta, true}}};

bool takes(LegKind kind, const FrictionKey& key) {
  const auto& has = rowOf(kind).coordinates;
  return (!key.of_urs_alone || kind == LegKind::URS) && std::find(has.begin(), has.end(), key.coordinate) != has.end();
}

std::string coordinatesOf(LegKind kind) {
  const auto& has = rowOf(kind).coordinates;
  return fmt::format("'{}', '{}' or '{}'", nameOf(has[0]), nameOf(has[1]), nameOf(has[2]));
}

/// Returns "'phi'", or several coordinates joined by "or".
std::string drivenBy(const Leg& leg) {
  std::vector<std::string> names;
  for (const Coordinate coordinate : rowOf(leg.kind).coordinates)
    if (leg.drives(coordinate)) names.push_back(fmt::format("'{}'", nameOf(coordinate)));
  return names.empty() ? "none, as no motor is on it" : fmt::format("{}", fmt::join(names, " or "));
}

/// Reads one leg from its tables: the defaults first, then its own.
class LegReader {
 public:
  LegReader(std::optional<TomlSection> defaults, const TomlSection& own, bool massless)
      : defaults_(std::move(defaults)), own_(own), massless_(massless) {}

  /// Throws at the leg's table for the first required key that neither table gave.
  Leg read() {
    readKind();
    for (const TomlSection* table : tables()) {
      table->allowOnly(keys_);
      readGeometry(*table);
      if (const auto friction = table->section("friction"))
        readFriction(*friction, "manipulator.leg.friction", table == &own_, leg_.friction);
      if (const auto coulomb = table->section("coulomb")) {
        readFriction(*coulomb, "manipulator.leg.coulomb", table == &own_, leg_.coulomb);
        coulomb->read("smoothing_speed", leg_.coulomb.smoothing_speed);
        leg_.coulomb.sliding_speed = leg_.coulomb.smoothing_speed;
      }
      if (const auto rotors = table->section("rotor_inertia")) readRotors(*rotors, table == &own_);
    }
    requireAll();
    if (massless_)
      for (Link* link : {&leg_.proximal, &leg_.distal}) *link = Link{link->length};
    return leg_;
  }

 private:
  std::vector<const TomlSection*> tables() const {
    if (defaults_) return {&*defaults_, &own_};
    return {&own_};
  }

  void note(const std::string& key, bool given) {
    if (given) given_.insert(key);
  }

  /// Reads `kind` first, because the meaning of the other keys depends on it.
  void readKind() {
    for (const TomlSection* table : tables())
      if (const auto kind = table->readChoice(keys_.key("kind"))) leg_.kind = static_cast<LegKind>(*kind);
    leg_.actuated.fill(false);
    leg_.actuated[rowOf(leg_.kind).actuated] = true;
    const TomlSection& table = own_.has("actuated") || !defaults_ ? own_ : *defaults_;
    if (const auto given = table.readStrings("actuated")) readActuated(table, *given);
  }

  void readActuated(const TomlSection& table, const std::vector<std::string>& names) {
    leg_.actuated.fill(false);
    for (const std::string& name : names) {
      const auto& has = rowOf(leg_.kind).coordinates;
      const auto found = std::find_if(has.begin(), has.end(), [&](Coordinate c) { return name == nameOf(c); });
      if (found == has.end())
        table.fail("actuated", fmt::format("'{}' is not a coordinate of {}, a {} leg, expected {}", name, own_.place(),
                                           rowOf(leg_.kind).name, coordinatesOf(leg_.kind)));
      bool& driven = leg_.actuated[found - has.begin()];
      if (driven) table.fail("actuated", fmt::format("'{}' twice", name));
      driven = true;
    }
  }

  void readGeometry(const TomlSection& table) {
    note("base_point", table.read("base_point", leg_.base_point));
    note("base_axis", table.read("base_axis", leg_.base_axis));
    note("platform_point", table.read("platform_point", leg_.platform_point));
    if (const auto link = table.section("proximal")) readLink(*link, "proximal", leg_.proximal);
    if (const auto link = table.section("distal")) readLink(*link, "distal", leg_.distal);
    if (const auto spin = table.readChoice(keys_.key("spin"))) leg_.spins = *spin == 1;
    if (const auto knee = table.readChoice(keys_.key("knee"))) leg_.knee = *knee == 0 ? Knee::positive : Knee::negative;
  }

  void readLink(const TomlSection& table, const std::string& name, Link& link) {
    table.allowOnly(scenarioTable("manipulator.leg.link"));
    note(name + ".length", table.read("length", link.length));
    note(name + ".mass", table.read("mass", link.mass));
    readCenter(table, name, link);
    note(name + ".inertia", table.readInertia("inertia", link.inertia));
  }

  /// Reads one number along the link's line, or three numbers.
  void readCenter(const TomlSection& table, const std::string& name, Link& link) {
    const toml::node* given = table.table().get("center_of_mass");
    if (given == nullptr) return;
    note(name + ".center_of_mass", true);
    link.off_line.setZero();
    if (!given->is_array()) {
      table.read("center_of_mass", link.center_of_mass);
      return;
    }
    table.read("center_of_mass", link.off_line);
    link.center_of_mass = std::exchange(link.off_line(&link == &leg_.proximal ? leg_.proximalLine() : 2), 0);
  }

  /// The defaults may name coordinates that motors drive on other legs.
  void readRotors(const TomlSection& table, bool own) {
    table.allowOnly(scenarioTable("manipulator.leg.rotor_inertia"));
    for (std::size_t k = 0; k < coordinate_count; ++k) {
      const auto coordinate = static_cast<Coordinate>(k);
      double value = 0;
      if (!table.read(nameOf(coordinate), value)) continue;
      if (leg_.drives(coordinate))
        leg_.rotor_inertia.on(coordinate) = value;
      else if (own && value != 0)
        table.fail(nameOf(coordinate), fmt::format("{}, but no motor drives {} of this leg, expected {}", value,
                                                   nameOf(coordinate), drivenBy(leg_)));
    }
  }

  /// The defaults may name coordinates that other legs have.
  void readFriction(const TomlSection& table, const char* name, bool own, JointFriction& friction) const {
    table.allowOnly(scenarioTable(name));
    std::set<Coordinate> given;
    for (const FrictionKey& key : friction_keys) {
      double value = 0;
      if (!table.read(key.name, value)) continue;
      if (takes(leg_.kind, key)) {
        if (!given.insert(key.coordinate).second)
          table.fail(key.name, fmt::format("given beside '{}', expected one of the two", nameOf(key.coordinate)));
        friction.on(key.coordinate) = value;
      } else if (own && value != 0) {
        table.fail(key.name, fmt::format("{}, but a {} leg has no such coordinate, expected {}", value,
                                         rowOf(leg_.kind).name, coordinatesOf(leg_.kind)));
      }
    }
  }

  void requireAll() const {
    require({"base_point", "base_axis", "platform_point"}, "an array of 3 numbers");
    for (const std::string link : {"proximal", "distal"}) {
      if (!rowOf(leg_.kind).hasCarriage() || link == "distal") require({link + ".length"}, "a number");
      if (massless_) continue;
      require({link + ".mass", link + ".center_of_mass"}, "a number");
      require({link + ".inertia"}, "an array of 3 or 6 numbers");
    }
  }

  void require(const std::vector<std::string>& keys, const std::string& expected) const {
    for (const std::string& key : keys)
      if (given_.count(key) == 0) own_.missing(key, expected + " here or in manipulator.leg_defaults");
  }

  std::optional<TomlSection> defaults_;
  const TomlSection& own_;
  bool massless_;
  const ScenarioTable& keys_ = scenarioTable("manipulator.leg");
  Leg leg_;
  std::set<std::string> given_;
};

/// Each friction coefficient of the defaults must apply to some leg.
void requireUse(const std::optional<TomlSection>& defaults, const std::vector<Leg>& legs) {
  if (!defaults) return;
  for (const char* name : {"friction", "coulomb"}) {
    const auto table = defaults->section(name);
    if (!table) continue;
    for (const FrictionKey& key : friction_keys) {
      double value = 0;
      if (!table->read(key.name, value) || value == 0) continue;
      if (std::none_of(legs.begin(), legs.end(), [&](const Leg& leg) { return takes(leg.kind, key); }))
        table->fail(key.name, fmt::format("{}, but no leg has such a coordinate, expected {}", value,
                                          coordinatesOf(legs.front().kind)));
    }
  }
}

/// Each rotor inertia of the defaults must apply to some motor.
void requireRotorUse(const std::optional<TomlSection>& defaults, const std::vector<Leg>& legs) {
  const auto table = defaults ? defaults->section("rotor_inertia") : std::nullopt;
  if (!table) return;
  for (std::size_t k = 0; k < coordinate_count; ++k) {
    const auto coordinate = static_cast<Coordinate>(k);
    double value = 0;
    if (!table->read(nameOf(coordinate), value) || value == 0) continue;
    if (std::none_of(legs.begin(), legs.end(), [&](const Leg& leg) { return leg.drives(coordinate); }))
      table->fail(nameOf(coordinate), fmt::format("{}, but no motor drives {}, expected {}", value, nameOf(coordinate),
                                                  drivenBy(legs.front())));
  }
}

Platform readPlatform(const TomlSection& table) {
  table.allowOnly(scenarioTable("manipulator.platform"));
  Platform platform;
  table.require("mass", platform.mass);
  table.require("center_of_mass", platform.center_of_mass);
  if (!table.readInertia("inertia", platform.inertia)) table.missing("inertia", "an array of 3 or 6 numbers");
  return platform;
}

void requireLegs(const TomlSection& manipulator, const std::vector<TomlSection>& legs) {
  const std::string expected = "expected three to six [[manipulator.leg]]";
  if (legs.empty()) manipulator.missing("leg", "three to six [[manipulator.leg]]");
  if (legs.size() > leg_count) legs[leg_count].fail("a surplus leg, " + expected);
  if (legs.size() < 3) manipulator.fail("leg", fmt::format("only {} of the legs, {}", legs.size(), expected));
}

}  // namespace

ManipulatorParameters readManipulator(const TomlSection& manipulator) {
  manipulator.allowOnly(scenarioTable("manipulator"));
  ManipulatorParameters parameters;
  manipulator.read("gravity", parameters.gravity);
  parameters.platform = readPlatform(manipulator.requiredSection("platform"));
  const std::optional<TomlSection> defaults = manipulator.section("leg_defaults");
  const std::vector<TomlSection> legs = manipulator.sections("leg");
  requireLegs(manipulator, legs);
  const bool massless = manipulator.readChoice(scenarioTable("manipulator").key("legs")) == 1U;
  parameters.legs.clear();
  for (const TomlSection& leg : legs) parameters.legs.push_back(LegReader(defaults, leg, massless).read());
  requireUse(defaults, parameters.legs);
  requireRotorUse(defaults, parameters.legs);
  return parameters;
}

}  // namespace ursula
