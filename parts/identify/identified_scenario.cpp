#include <fmt/format.h>

#include <map>
#include <set>

#include "model/scenario_numbers.h"
#include "model/toml_reader.h"
#include "model/toml_writer.h"
#include "parts/identify/results.h"

namespace ursula::identification {
namespace {

/// A log says nothing of a number if more than this share of its prior uncertainty remains.
constexpr double says_nothing = 0.9;

/// Writes numbers with their tolerances into a document.
class ScenarioMarker {
 public:
  explicit ScenarioMarker(toml::table& document) : document_(document), numbers_(document) {}

  void set(const MachineNumber& number, double value, double tolerance, const ManipulatorParameters& machine) {
    if (!hold(number, machine)) return;
    toml::table& stated = marks_[numbers_.last()];
    stated.insert_or_assign("value", value);
    stated.insert_or_assign("tolerance", tolerance);
    stated.is_inline(true);
  }

  /// Call this last, because numbers are looked up as plain ones.
  void apply() { mark(document_); }

 private:
  void mark(toml::node& node) {
    if (toml::table* table = node.as_table()) {
      for (auto&& [key, child] : *table)
        if (const auto at = marks_.find(&child); at != marks_.end())
          table->insert_or_assign(std::string(key.str()), std::move(at->second));
        else
          mark(child);
    } else if (toml::array* array = node.as_array()) {
      for (auto child = array->begin(); child != array->end(); ++child)
        if (const auto at = marks_.find(&*child); at != marks_.end())
          array->replace(child, std::move(at->second));
        else
          mark(*child);
    }
  }

  /// Writes the number out of the defaults. Returns false if the document cannot have it.
  bool hold(const MachineNumber& number, const ManipulatorParameters& machine) {
    if (number.group() == NumberGroup::inertia) makeSix(number);
    if (hold(number.path)) return true;
    if (number.quantity != Quantity::center) return false;
    const Leg& leg = machine.legs[number.leg];
    return hold(fmt::format("{}.{}", number.path, number.body == NumberBody::proximal ? leg.proximalLine() : 2));
  }

  bool hold(const std::string& path) {
    try {
      numbers_.hold(path);
      return true;
    } catch (const NumberKeyError&) {
      return false;
    }
  }

  /// The document may give moments of inertia without products.
  void makeSix(const MachineNumber& number) {
    hold(number.path.substr(0, number.path.rfind('.')) + ".0");
    const std::string of = number.leg < 0 ? "platform" : fmt::format("leg[{}].{}", number.leg, name(number.body));
    toml::array* entries = toml::at_path(document_, "manipulator." + of + ".inertia").as_array();
    if (entries != nullptr && entries->size() == 3) entries->resize(6, 0.0);
  }

  toml::table& document_;
  ScenarioNumbers numbers_;
  std::map<const toml::node*, toml::table> marks_;
};

/// Returns the array of a body's tensor; empty for other numbers.
std::string tensorOf(const MachineNumber& number) {
  return number.group() == NumberGroup::inertia ? number.path.substr(0, number.path.rfind('.')) : "";
}

bool isShown(const NumberEstimate& each) {
  const MeasuredNumber& measured = each.measured;
  if (each.before == 0 || measured.uncertainty > says_nothing * each.before) return false;
  const NumberGroup group = each.number.group();
  const bool may_be_none = group == NumberGroup::friction || group == NumberGroup::rotor;
  return !may_be_none || measured.nominal > 1e-200 || measured.value > 2 * measured.uncertainty;
}

}  // namespace

std::string identifiedScenario(const Scenario& scenario, const std::vector<NumberEstimate>& estimates) {
  if (!scenario.isAsRead()) return "";
  toml::table document = parseToml(scenario.text, scenario.file.string());
  takeTolerances(document, scenario.file.string());
  const ManipulatorParameters& machine = scenario.manipulator->given();
  NumberTolerances others = statedTolerances(scenario);
  ScenarioMarker marker(document);
  // A tensor is written as a whole: the estimate is one that a body can have, and a mixture with the old one need not
  // be.
  std::set<std::string> tensors;
  for (const NumberEstimate& each : estimates)
    if (isShown(each)) tensors.insert(tensorOf(each.number));
  for (const NumberEstimate& each : estimates) {
    const std::string tensor = tensorOf(each.number);
    if (!isShown(each) && (tensor.empty() || tensors.count(tensor) == 0)) continue;
    marker.set(each.number, each.measured.value, each.measured.uncertainty, machine);
    others.erase(each.number.path);
  }
  for (const MachineNumber& number : machineNumbers(machine))
    if (const auto at = others.find(number.path); at != others.end())
      marker.set(number, number.get(machine), at->second, machine);
  marker.apply();
  return tomlText(document);
}

}  // namespace ursula::identification
