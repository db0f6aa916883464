#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/scenario_numbers.h"
#include "model/toml_reader.h"
#include "model/toml_writer.h"
#include "studies/identify/results.h"

namespace ursula::identification {
namespace {

/// A log says nothing of a number if more than this share of its prior uncertainty remains.
constexpr double says_nothing = 0.9;

/// A node at a dotted path, as takeTolerances writes it, with its parent.
struct NodePlace {
  toml::node* parent = nullptr;
  toml::node* node = nullptr;
  std::string key;
};

NodePlace placeOf(toml::table& document, const std::string& path) {
  NodePlace out{nullptr, &document, ""};
  for (std::size_t begin = 0; begin <= path.size() && out.node != nullptr;) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    std::string key = path.substr(begin, end - begin);
    begin = end + 1;
    out.parent = out.node;
    if (toml::table* table = out.parent->as_table()) {
      if (!table->contains(key)) key = otherFrictionName(key);
      out.node = table->get(key);
    } else if (toml::array* array = out.parent->as_array()) {
      const bool tables =
          !array->empty() && array->front().is_table() && array->front().as_table()->get("value") == nullptr;
      out.node = array->get(std::stoul(key) - (tables ? 1 : 0));
    } else {
      out.node = nullptr;
    }
    out.key = key;
  }
  return out;
}

/// Writes numbers with their tolerances into a document.
class ScenarioMarker {
 public:
  explicit ScenarioMarker(toml::table& document) : document_(document) {}

  void set(const MachineNumber& number, double value, double tolerance, const ManipulatorParameters& machine) {
    const std::string path = held(number, machine);
    if (path.empty()) return;
    toml::table stated;
    stated.insert("value", value);
    stated.insert("tolerance", tolerance);
    stated.is_inline(true);
    marks_.emplace_back(path, std::move(stated));
  }

  /// Call this last, because numbers are looked up as plain ones.
  void apply() {
    for (auto& [path, stated] : marks_) {
      const NodePlace at = placeOf(document_, path);
      if (at.node == nullptr) continue;
      if (toml::table* table = at.parent->as_table())
        table->insert_or_assign(at.key, std::move(stated));
      else
        at.parent->as_array()->replace(at.parent->as_array()->cbegin() + std::stol(at.key), std::move(stated));
    }
  }

 private:
  /// Returns the number's path in the document, written out of the defaults; empty if the document cannot have it.
  std::string held(const MachineNumber& number, const ManipulatorParameters& machine) {
    std::string path = number.path;
    if (number.group == "inertia") makeSix(path);
    if (hold(path)) return path;
    if (number.quantity != Quantity::center) return "";
    const Leg& leg = machine.legs[number.leg];
    path += fmt::format(".{}", number.body == "proximal" ? leg.proximalLine() : 2);
    return hold(path) ? path : "";
  }

  bool hold(const std::string& path) {
    try {
      ScenarioNumbers(document_).hold(path);
      return true;
    } catch (const NumberKeyError&) {
      return false;
    }
  }

  /// The document may give moments of inertia without products.
  void makeSix(const std::string& path) {
    hold(path.substr(0, path.rfind('.')) + ".0");
    toml::array* entries = placeOf(document_, path.substr(0, path.rfind('.'))).node->as_array();
    while (entries != nullptr && entries->size() == 3) {
      entries->push_back(0.0);
      entries->push_back(0.0);
      entries->push_back(0.0);
    }
  }

  toml::table& document_;
  std::vector<std::pair<std::string, toml::table>> marks_;
};

/// The array of a body's tensor; empty for other numbers.
std::string tensorOf(const MachineNumber& number) {
  return number.group == "inertia" ? number.path.substr(0, number.path.rfind('.')) : "";
}

bool isShown(const NumberEstimate& each) {
  if (each.before == 0 || each.deviation > says_nothing * each.before) return false;
  const bool may_be_none = each.number.group == "friction" || each.number.group == "rotor";
  return !may_be_none || each.nominal > 1e-200 || each.value > 2 * each.deviation;
}

}  // namespace

std::string identifiedScenario(const Scenario& scenario, const PhysicalEstimate& estimate) {
  if (!scenario.isAsRead()) return "";
  toml::table document = parseToml(scenario.text, scenario.file.string());
  takeTolerances(document, scenario.file.string());
  const ManipulatorParameters& machine = scenario.manipulator->given();
  NumberTolerances others = statedTolerances(scenario);
  ScenarioMarker marker(document);
  // A tensor is written as a whole: the estimate is one that a body can have, and a mixture with the old one need not
  // be.
  std::set<std::string> tensors;
  for (const NumberEstimate& each : estimate.numbers)
    if (isShown(each)) tensors.insert(tensorOf(each.number));
  for (const NumberEstimate& each : estimate.numbers) {
    const std::string tensor = tensorOf(each.number);
    if (!isShown(each) && (tensor.empty() || tensors.count(tensor) == 0)) continue;
    marker.set(each.number, each.value, each.deviation, machine);
    others.erase(each.number.path);
  }
  for (const MachineNumber& number : machineNumbers(machine))
    if (const auto at = others.find(number.path); at != others.end())
      marker.set(number, number.get(machine), at->second, machine);
  marker.apply();
  return tomlText(document);
}

}  // namespace ursula::identification
