// The table of keys against the reader: types, defaults and bounds in the docs are those that it applies.

#include "model/scenario_keys.h"

#include <set>

#include "model/scenario.h"
#include "tests/base/temporary_folder.h"
#include "tests/model/refusals.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string points =
    "points = [{ time = 0, position = [0, 0, 1], orientation = [1, 0, 0, 0] }, { time = 2, position = [0, 0, 1.1], "
    "orientation = [1, 0, 0, 0] }]";

/// A scenario with `line` in the table of that name; it replaces the same key if that exists.
std::string withLine(const std::string& table, const std::string& key, const std::string& line) {
  const std::string machine = good_scenario.substr(0, good_scenario.find("[trajectory]"));
  using Lines = std::vector<std::pair<std::string, std::string>>;
  const auto in = [&](const std::string& header, const Lines& lines, const std::string& last) {
    std::string text = header + "\n";
    for (const auto& [name, value] : lines)
      if (name != key && name + "_deg" != key) text += value + "\n";
    return text + last + "\n";
  };
  if (table == "trajectory.hold")
    return machine + in("[trajectory]",
                        {{"kind", "kind = \"hold\""},
                         {"position", "position = [0, 0, 1]"},
                         {"orientation", "orientation = [1, 0, 0, 0]"},
                         {"duration", "duration = 1"}},
                        line);
  if (table == "trajectory.helix")
    return machine + in("[trajectory]",
                        {{"kind", "kind = \"helix\""},
                         {"duration", "duration = 3"},
                         {"radius", "radius = 0.2"},
                         {"pitch", "pitch = 1.2"},
                         {"start_angle", "start_angle = -1.5"},
                         {"end_angle", "end_angle = -1.0"}},
                        line);
  if (table == "trajectory.waypoints")
    return machine + in("[trajectory]", {{"kind", "kind = \"waypoints\""}, {"points", points}}, line);
  const bool is_history = key == "file" || key == "table";
  if (table == "load")
    return good_scenario + in("[load]", is_history ? Lines{} : Lines{{"moment", "moment = [1, 2, 3]"}}, line);
  if (table == "simulation") return good_scenario + in("[simulation]", {}, line);
  if (table == "acceptance.torque")
    return good_scenario +
           in("[acceptance.torque]", {{"relative", "relative = 1"}, {"absolute", "absolute = 1"}}, line);
  if (table == "manipulator") return replaced(good_scenario, "[manipulator]\n", in("[manipulator]", {}, line));
  if (table == "manipulator.platform")
    return good_scenario.substr(0, good_scenario.find("[manipulator.platform]")) +
           in("[manipulator.platform]",
              {{"mass", "mass = 500"},
               {"center_of_mass", "center_of_mass = [0, 0, 1.88]"},
               {"inertia", "inertia = [800, 810, 820]"}},
              line) +
           good_scenario.substr(good_scenario.find("[manipulator.leg_defaults]"));
  const auto first = good_scenario.find("[[manipulator.leg]]"),
             second = good_scenario.find("[[manipulator.leg]]", first + 1);
  const auto leg = [&](const std::string& last) {
    return good_scenario.substr(0, first) +
           in("[[manipulator.leg]]",
              {{"base_point", "base_point = [-0.0953, -1.9682, 0.0]"},
               {"base_axis", "base_axis = [-0.9397, 0.0, 0.3420]"},
               {"platform_point", "platform_point = [-0.0667, -1.3847, 0.0]"}},
              last) +
           good_scenario.substr(second);
  };
  if (table == "manipulator.leg") return leg(line);
  const std::string part = table == "manipulator.leg.link" ? "proximal" : table.substr(table.rfind('.') + 1);
  // No coordinate of URS slides. A rotor is on a driven coordinate.
  const bool other_motor = table == "manipulator.leg.rotor_inertia" && key != "d";
  return leg((key == "d"    ? "kind = \"UPS\"\n"
              : other_motor ? "actuated = [\"" + key + "\"]\n"
                            : "") +
             part + " = { " + line + " }");
}

bool isTried(const std::string& table) {
  static const std::set<std::string> others = {
      "", "trajectory", "trajectory.waypoints.points", "trajectory.samples", "load.table", "acceptance"};
  return others.count(table) == 0;
}

/// The expectation in a refusal, by the type in the table.
std::string expectation(const ScenarioKey& key) {
  switch (key.type) {
    case KeyType::number:
      return "expected a number";
    case KeyType::integer:
      return "expected an integer";
    case KeyType::string:
      return "expected a string";
    case KeyType::choice:
      return "expected '";
    case KeyType::choices:
      return "expected an array of strings";
    case KeyType::vector:
      return "expected an array of 3 numbers";
    case KeyType::numbers:
      return "expected an array of numbers";
    case KeyType::quaternion:
      return "expected an array of 4 numbers";
    case KeyType::share:
    case KeyType::center:
      return "expected a number";
    case KeyType::inertia:
      return "expected an array of 3 or 6 numbers";
    case KeyType::tables:
      return "expected an array of tables";
    case KeyType::table:
    case KeyType::limits:
      break;
  }
  return "expected a table";
}

TEST(ScenarioKeys, haveTheTypesThatTheReaderTakes) {
  int tried = 0;
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys) {
      const bool repeats = key.type == KeyType::table || key.name == std::string("leg");
      if (!isTried(table.name) || repeats) continue;
      const std::string text = withLine(table.name, key.name, std::string(key.name) + " = true");
      EXPECT_THAT(refusal<ScenarioError>([&] { parseScenario(text, "a.toml"); }),
                  testing::AllOf(HasSubstr(std::string(key.name) + ": a boolean"), HasSubstr(expectation(key))))
          << table.name << '.' << key.name;
      ++tried;
    }
  EXPECT_GE(tried, 50);
}

TEST(ScenarioKeys, haveNoOtherNames) {
  int tried = 0;
  for (const ScenarioTable& table : scenarioTables()) {
    if (!isTried(table.name) || table.name == std::string("acceptance.torque")) continue;  // it names checks
    const std::string said =
        refusal<ScenarioError>([&] { parseScenario(withLine(table.name, "zz", "zz = 1"), "a.toml"); });
    EXPECT_THAT(said, HasSubstr(": error: unknown key 'zz' in ")) << table.name;
    for (const ScenarioKey& key : table.keys)
      EXPECT_THAT(said.substr(said.find("expected ")), HasSubstr("'" + std::string(key.name) + "'")) << table.name;
    ++tried;
  }
  EXPECT_GE(tried, 11);
}

/// All that a scenario's keys can change, as numbers.
std::vector<double> numbersOf(const Scenario& scenario) {
  std::vector<double> out;
  const ManipulatorParameters& machine = scenario.manipulator->parameters();
  for (int k = 0; k < 3; ++k) out.push_back(machine.gravity(k));
  for (const Leg& leg : machine.legs)
    for (const JointFriction& friction : {leg.friction, static_cast<const JointFriction&>(leg.coulomb)})
      out.insert(out.end(), {friction.phi, friction.psi, friction.theta, friction.d, leg.coulomb.smoothing_speed,
                             leg.coulomb.sliding_speed, leg.knee == Knee::positive ? 1.0 : -1.0, leg.rotor_inertia.phi,
                             leg.rotor_inertia.d, leg.spins ? 1.0 : 0.0});
  for (double t : {0.0, 0.4, 1.0}) {
    const Motion<double> motion = scenario.trajectory->at(t);
    out.insert(out.end(), motion.p.data(), motion.p.data() + 3);
    out.insert(out.end(), motion.Q.data(), motion.Q.data() + 9);
  }
  if (scenario.load) {
    const Load& load = *scenario.load;
    for (const Vector3d& v : {load.force, load.moment, load.point}) out.insert(out.end(), v.data(), v.data() + 3);
    out.push_back(load.frame == Load::Frame::base ? 0 : 1);
  }
  out.insert(out.end(), {static_cast<double>(scenario.simulation.samples), scenario.simulation.tolerance,
                         scenario.simulation.integrator == Integrator::rkf78 ? 0.0 : 1.0});
  return out;
}

TEST(ScenarioKeys, haveTheDefaultsThatTheReaderTakes) {
  int tried = 0;
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys) {
      if (!isTried(table.name) || key.isRequired() || key.fallback[0] == '\0') continue;
      const std::string line = std::string(key.name) + " = " + key.fallback;
      const bool of_friction = std::string(table.name).find("friction") != std::string::npos;
      // The good scenario's defaults already have friction.
      const std::string plain = of_friction ? "friction = { actuated = 0.5, universal = 0.25, knee = 0.125 }" : "";
      const auto read = [&](const std::string& with) {
        const std::string text = withLine(table.name, key.name, with);
        return numbersOf(parseScenario(of_friction ? replaced(text, plain, "") : text, "a.toml"));
      };
      const bool is_load_force = table.name == std::string("load") && key.name == std::string("moment");
      if (is_load_force) continue;  // without it the load would be empty
      EXPECT_EQ(read(line), read("")) << table.name << '.' << key.name;
      ++tried;
    }
  EXPECT_GE(tried, 15);
}

TEST(ScenarioKeys, haveTheBoundsThatTheReaderHolds) {
  int tried = 0;
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys) {
      if (!isTried(table.name) || key.bound.words[0] == '\0') continue;
      for (const char* value : {"-1", "0", "1", "2000000"}) {
        const std::string text = withLine(table.name, key.name, std::string(key.name) + " = " + value);
        const std::string place = std::string(table.name) + "." + key.name + " = " + value;
        const bool without_mass = place == "manipulator.leg.link.mass = 0";  // needs an inertia of zero as well
        if (without_mass) {
          EXPECT_THAT(refusal<ScenarioError>([&] { parseScenario(text, "a.toml"); }), HasSubstr(", expected zero"));
        } else if (key.bound.holds(std::atof(value))) {
          EXPECT_NO_THROW(parseScenario(text, "a.toml")) << place;
        } else {
          EXPECT_THAT(refusal<ScenarioError>([&] { parseScenario(text, "a.toml"); }),
                      HasSubstr(std::string(value) + ", expected " + key.bound.words))
              << place;
          ++tried;
        }
      }
    }
  EXPECT_GE(tried, 25);
}

TEST(ScenarioKeys, ofSubtablesAreThere) {
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys)
      if (key.of[0] != '\0') {
        EXPECT_NO_THROW(scenarioTable(key.of)) << key.name;
      }
  EXPECT_THROW(scenarioTable("none"), std::out_of_range);
  EXPECT_THROW(scenarioTable("load").key("none"), std::out_of_range);
}

}  // namespace
}  // namespace ursula
