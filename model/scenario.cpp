#include "model/scenario.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/text_source.h"
#include "base/toml_bounds.h"
#include "model/check_catalogue.h"
#include "model/scenario_excerpt.h"
#include "model/scenario_files.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

constexpr const char* verbs_with_mechanism = "check, validate, inverse, direct, simulate and sweep";

/// The name must suit a folder, because results go into a folder of that name.
std::string readName(const TomlSection& document) {
  std::string name;
  document.require("name", name);
  const bool plain = std::none_of(name.begin(), name.end(),
                                  [](unsigned char c) { return c < ' ' || c == 0x7f || c == '/' || c == '\\'; });
  constexpr std::size_t most = 255;  // bytes of a name in Linux
  if (name.size() > most)
    document.fail("name",
                  fmt::format("{} bytes, expected a name that a folder can have, of at most {}", name.size(), most));
  if (!plain || name.empty() || name == "." || name == "..")
    document.fail("name", fmt::format("'{}', expected a name that a folder can have, without '/'", shown(name)));
  return name;
}

SimulationSettings readSimulation(const TomlSection& table) {
  const ScenarioTable& keys = scenarioTable("simulation");
  table.allowOnly(keys);
  SimulationSettings settings;
  table.read("samples", settings.samples);
  table.requireBound(keys.key("samples"), settings.samples);
  if (const auto integrator = table.readChoice(keys.key("integrator")))
    settings.integrator = *integrator == 0 ? Integrator::rkf78 : Integrator::rk_merson;
  table.read("tolerance", settings.tolerance);
  table.requireBound(keys.key("tolerance"), settings.tolerance);
  return settings;
}

/// Reads `torque = { relative = X, absolute = Y }`; either may be missing.
EffortTolerance readTolerance(const TomlSection& table) {
  EffortTolerance tolerance;
  for (const auto& [key, member] :
       {std::pair("relative", &EffortTolerance::relative), {"absolute", &EffortTolerance::absolute}}) {
    if (!table.table().contains(key)) continue;
    if (scenarioTable("acceptance.torque").key(key).type == KeyType::share)
      table.requireShare(key, tolerance.*member);
    else
      table.require(key, tolerance.*member);
    table.requireBound(scenarioTable("acceptance.torque").key(key), tolerance.*member);
  }
  return tolerance;
}

/// Check names contain dots: "a.b" = 1, a.b = 1 and [acceptance.a] b = 1 all mean the check a.b.
void readAcceptance(const TomlSection& table, const std::string& prefix, Scenario& scenario) {
  std::vector<AcceptanceLimit>& limits = scenario.acceptance;
  for (const auto& [key, node] : table.table()) {
    const std::string name(key.str());
    if (prefix == "torque." && (name == "relative" || name == "absolute")) {
      scenario.tolerance = readTolerance(table);
      continue;
    }
    if (node.is_table() && node.as_table()->empty())
      table.fail(name, "an empty table, expected a limit, or for torque relative or absolute");
    if (prefix.empty() && name == "torque" && !node.is_table())
      table.fail(name, fmt::format("{}, expected a table {{ relative = X, absolute = Y }}",
                                   node.is_floating_point() ? "a float"
                                   : node.is_integer()      ? "an integer"
                                   : node.is_string()       ? "a string"
                                                            : "no table"));
    if (node.is_table()) {
      readAcceptance(*table.section(name), prefix + name + ".", scenario);
      continue;
    }
    AcceptanceLimit limit;
    limit.check = prefix + name;
    std::vector<std::string> known = namesOfChecks();
    if (std::find(known.begin(), known.end(), limit.check) == known.end()) {
      known.insert(known.end(), {"torque.relative", "torque.absolute"});
      table.fail(name, fmt::format("'{}' is not a check{}", shown(limit.check), didYouMean(limit.check, known)));
    }
    table.require(name, limit.limit);
    if (!(limit.limit > 0)) table.fail(name, fmt::format("{}, expected a number > 0", limit.limit));
    const auto same = [&](const AcceptanceLimit& other) { return other.check == limit.check; };
    if (std::any_of(limits.begin(), limits.end(), same)) table.fail(name, "a second limit for one check, expected one");
    limits.push_back(limit);
  }
}

Scenario assemble(const TomlSection& document) {
  document.allowOnly(scenarioTable(""));
  Scenario scenario;
  readJudging(document, scenario);
  if (!document.has("manipulator")) document.missing("manipulator", "a table [manipulator] or [mechanism]");
  scenario.manipulator = std::make_shared<Manipulator>(readManipulator(document.requiredSection("manipulator")));
  scenario.trajectory = readTrajectory(document.requiredSection("trajectory"));
  if (const auto table = document.section("load")) scenario.load = readLoad(*table);
  return scenario;
}

}  // namespace

void requireOneMachine(const TomlSection& document) {
  if (document.has("manipulator") && document.has("mechanism"))
    document.fail("mechanism", "beside [manipulator], expected one of the two");
}

void requireManipulator(const TomlSection& document) {
  requireOneMachine(document);
  if (document.has("mechanism"))
    document.fail("mechanism", "this verb takes a scenario with [manipulator], and this one has [mechanism], which " +
                                   std::string(verbs_with_mechanism) + " take");
}

void readJudging(const TomlSection& document, Scenario& scenario) {
  scenario.name = readName(document);
  if (const auto table = document.section("simulation")) scenario.simulation = readSimulation(*table);
  if (const auto table = document.section("acceptance")) readAcceptance(*table, "", scenario);
}

Scenario parseScenario(const std::string& text, const std::filesystem::path& file) {
  toml::table table = parseToml(text, file.string());
  takeTolerances(table, file.string());  // the text keeps them, for statedTolerances()
  const TomlSection document(table, "", file.string());
  try {
    requireManipulator(document);
  } catch (const PlacedError& error) {
    throw error.in(text);  // alone: what else such a text has is not judged by the keys of a manipulator
  }
  try {
    Scenario scenario = assemble(document);
    scenario.file = file;
    scenario.text = text;
    scenario.markAsRead();
    return scenario;
  } catch (const PlacedError& error) {
    throw withOthers(error, document, text);
  } catch (const InvalidParameter& refusal) {
    throw withOthers(located(refusal, document), document, text);
  } catch (const CsvError& error) {
    throw withOthers({error.what(), 0, 0}, document, text);
  }
}

Scenario readScenario(const std::filesystem::path& file) { return parseScenario(scenarioText(file), file); }

}  // namespace ursula
