#include <fmt/format.h>

#include <set>

#include "model/scenario_sections.h"

namespace ursula {
namespace {

/// Reads what tables give of one leg, the defaults first and the leg's own over them, and remembers which keys came.
class LegReader {
 public:
  void apply(const TomlSection& table) {
    const ScenarioTable& keys = scenarioTable("manipulator.leg");
    table.allowOnly(keys);
    note("base_point", table.read("base_point", leg_.base_point));
    note("base_axis", table.read("base_axis", leg_.base_axis));
    note("platform_point", table.read("platform_point", leg_.platform_point));
    if (const auto link = table.section("proximal")) applyLink(*link, "proximal", leg_.proximal);
    if (const auto link = table.section("distal")) applyLink(*link, "distal", leg_.distal);
    if (const auto knee = table.readChoice(keys.key("knee"))) leg_.knee = *knee == 0 ? Knee::positive : Knee::negative;
    if (const auto friction = table.section("friction")) {
      friction->allowOnly(scenarioTable("manipulator.leg.friction"));
      applyFriction(*friction, leg_.friction);
    }
    if (const auto coulomb = table.section("coulomb")) {
      coulomb->allowOnly(scenarioTable("manipulator.leg.coulomb"));
      applyFriction(*coulomb, leg_.coulomb);
      coulomb->read("smoothing_speed", leg_.coulomb.smoothing_speed);
    }
  }

  /// Throws at the leg's table for the first required key that neither it nor the defaults gave.
  const Leg& complete(const TomlSection& table) const {
    require(table, {"base_point", "base_axis", "platform_point"}, "an array of 3 numbers");
    for (const std::string link : {"proximal", "distal"}) {
      require(table, {link + ".length", link + ".mass", link + ".center_of_mass"}, "a number");
      require(table, {link + ".inertia"}, "an array of 3 or 6 numbers");
    }
    return leg_;
  }

 private:
  void note(const std::string& key, bool given) {
    if (given) given_.insert(key);
  }

  void applyLink(const TomlSection& table, const std::string& name, Link& link) {
    table.allowOnly(scenarioTable("manipulator.leg.link"));
    note(name + ".length", table.read("length", link.length));
    note(name + ".mass", table.read("mass", link.mass));
    note(name + ".center_of_mass", table.read("center_of_mass", link.center_of_mass));
    note(name + ".inertia", table.readInertia("inertia", link.inertia));
  }

  static void applyFriction(const TomlSection& table, JointFriction& friction) {
    table.read("actuated", friction.actuated);
    table.read("universal", friction.universal);
    table.read("knee", friction.knee);
  }

  void require(const TomlSection& table, const std::vector<std::string>& keys, const std::string& expected) const {
    for (const std::string& key : keys)
      if (given_.count(key) == 0) table.missing(key, expected + " here or in manipulator.leg_defaults");
  }

  Leg leg_;
  std::set<std::string> given_;
};

Platform readPlatform(const TomlSection& table) {
  table.allowOnly(scenarioTable("manipulator.platform"));
  Platform platform;
  table.require("mass", platform.mass);
  table.require("center_of_mass", platform.center_of_mass);
  if (!table.readInertia("inertia", platform.inertia)) table.missing("inertia", "an array of 3 or 6 numbers");
  return platform;
}

void requireSixLegs(const TomlSection& manipulator, const std::vector<TomlSection>& legs) {
  const std::string expected = "expected exactly six [[manipulator.leg]]";
  if (legs.empty()) manipulator.missing("leg", "six [[manipulator.leg]]");
  if (legs.size() > leg_count) legs[leg_count].fail("a surplus leg, " + expected);
  if (legs.size() < leg_count) manipulator.fail("leg", fmt::format("only {} of the legs, {}", legs.size(), expected));
}

}  // namespace

ManipulatorParameters readManipulator(const TomlSection& manipulator) {
  manipulator.allowOnly(scenarioTable("manipulator"));
  ManipulatorParameters parameters;
  manipulator.read("gravity", parameters.gravity);
  parameters.platform = readPlatform(manipulator.requiredSection("platform"));
  LegReader defaults;
  if (const auto table = manipulator.section("leg_defaults")) defaults.apply(*table);
  const std::vector<TomlSection> legs = manipulator.sections("leg");
  requireSixLegs(manipulator, legs);
  for (std::size_t i = 0; i < leg_count; ++i) {
    LegReader reader = defaults;
    reader.apply(legs[i]);
    parameters.legs[i] = reader.complete(legs[i]);
  }
  return parameters;
}

}  // namespace ursula
