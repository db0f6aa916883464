#include <fmt/format.h>

#include <cstdlib>

#include "model/scenario_sections.h"

namespace ursula {
namespace {

/// `leg[2]` of a dotted place: a key and the 1-based index behind it, 0 where there is none.
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

const toml::node* child(const toml::node& node, const Step& step) {
  const toml::table* table = node.as_table();
  const toml::node* found = table ? table->get(step.key) : nullptr;
  if (!found || step.index == 0) return found;
  const toml::array* array = found->as_array();
  return array ? array->get(step.index - 1) : nullptr;
}

/// How far a way leads into the document: the last node there is, and how many steps reach it.
struct Reached {
  const toml::node* node;
  std::size_t steps;
};

Reached walk(const toml::node& document, const std::vector<Step>& steps) {
  Reached reached{&document, 0};
  for (const Step& step : steps) {
    const toml::node* next = child(*reached.node, step);
    if (!next) break;
    reached = {next, reached.steps + 1};
  }
  return reached;
}

}  // namespace

ScenarioError located(const InvalidParameter& refusal, const TomlSection& document) {
  std::vector<Step> steps = stepsOf(refusal.place());
  std::string place = refusal.place();
  Reached reached = walk(document.table(), steps);
  const bool of_leg = steps.size() > 2 && steps[0].key == "manipulator" && steps[1].key == "leg";
  if (of_leg && reached.steps < steps.size()) {
    const std::size_t leg = steps[1].index;
    steps[1] = {"leg_defaults", 0};
    if (const Reached inherited = walk(document.table(), steps); inherited.steps == steps.size()) {
      reached = inherited;
      place = fmt::format("manipulator.leg_defaults{} (of leg {})", place.substr(place.find(']') + 1), leg);
    }
  }
  return errorAt(document.file(), reached.node->source().begin,
                 fmt::format("{}: {}, expected {}", place, refusal.value(), refusal.bound()));
}

}  // namespace ursula
