#include "model/scenario_files.h"

#include <fmt/format.h>

#include <cstdlib>

#include "model/scenario_keys.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

/// `leg[2]` of a dotted place: a key and its 1-based index, 0 if there is none.
struct Step {
  std::string key;
  std::size_t index = 0;
};

std::vector<Step> stepsOf(const std::string& place) {
  std::vector<Step> steps;
  for (std::size_t begin = 0; begin <= place.size();) {
    const std::size_t end = std::min(place.find('.', begin), place.size());
    Step step{place.substr(begin, end - begin), 0};
    if (const auto bracket = step.key.find('['); bracket != std::string::npos) {
      step.index = std::strtoul(step.key.c_str() + bracket + 1, nullptr, 10);
      step.key.resize(bracket);
    }
    steps.push_back(step);
    begin = end + 1;
  }
  return steps;
}

const toml::node* child(const toml::node& node, Step& step) {
  const toml::table* table = node.as_table();
  const toml::node* found = table ? table->get(step.key) : nullptr;
  if (const std::string other = otherFrictionName(step.key);
      table && !found && !other.empty() && table->contains(other)) {
    step.key = other;
    found = table->get(other);
  }
  if (!found || step.index == 0) return found;
  const toml::array* array = found->as_array();
  return array ? array->get(step.index - 1) : nullptr;
}

/// How far a path leads into the document: the last node found, and the number of steps to it.
struct Reached {
  const toml::node* node;
  std::size_t steps;
};

/// Replaces steps by the names that the file uses.
Reached walk(const toml::node& document, std::vector<Step>& steps) {
  Reached reached{&document, 0};
  for (Step& step : steps) {
    const toml::node* next = child(*reached.node, step);
    if (!next) break;
    reached = {next, reached.steps + 1};
  }
  return reached;
}

/// The node at a dotted key, and the key under which it was found.
struct Found {
  const toml::node* node;
  std::string key;
  bool given;
};

std::string joined(const std::vector<Step>& steps, std::size_t from) {
  std::string out;
  for (std::size_t k = from; k < steps.size(); ++k) {
    if (k > 0) out += '.';
    out += steps[k].key;
    if (steps[k].index > 0) out += fmt::format("[{}]", steps[k].index);
  }
  return out;
}

/// Finds a leg's own key, the inherited one in manipulator.leg_defaults, or the nearest enclosing table.
Found find(const toml::table& document, const std::string& key) {
  std::vector<Step> steps = stepsOf(key);
  const Reached reached = walk(document, steps);
  const bool of_leg = steps.size() > 2 && steps[0].key == "manipulator" && steps[1].key == "leg";
  if (of_leg && reached.steps < steps.size()) {
    const std::size_t leg = steps[1].index;
    steps[1] = {"leg_defaults", 0};
    if (const Reached inherited = walk(document, steps); inherited.steps == steps.size())
      return {inherited.node, fmt::format("manipulator.leg_defaults{} (of leg {})", joined(steps, 2), leg), true};
    return {reached.node, key, false};
  }
  return {reached.node, joined(steps, 0), reached.steps == steps.size()};
}

}  // namespace

PlacedError located(const InvalidParameter& refusal, const TomlSection& document) {
  const Found found = find(document.table(), refusal.place());
  return errorAt(document.file(), found.node->source().begin,
                 fmt::format("{}: {}, expected {}", found.key, refusal.value(), refusal.bound()));
}

KeyPlace placeInFile(const Scenario& scenario, const std::string& key) {
  try {
    toml::table document = parseToml(scenario.text, scenario.file.string());
    takeTolerances(document, scenario.file.string());
    const Found found = find(document, key);
    return {placeAt(scenario.file.string(), found.node->source().begin), found.key, found.given,
            found.node->value<double>()};
  } catch (const ScenarioError&) {
    return {placeAt(scenario.file.string(), {}), key, false, std::nullopt};
  }
}

}  // namespace ursula
