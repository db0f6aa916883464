#include "model/number_tolerances.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/text.h"
#include "model/machine_numbers.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

/// Takes all tolerances in one pass through a document.
class ToleranceTaker {
 public:
  explicit ToleranceTaker(const std::string& file) : file_(file) {}

  void walk(toml::node& node, const std::string& path) {
    if (toml::table* table = node.as_table()) {
      for (auto&& [key, child] : *table) {
        const std::string name(key.str());
        const std::string place = path.empty() ? name : path + "." + name;
        if (isStated(child))
          taken(child, place).visit([&, table = table](auto& value) {
            table->insert_or_assign(name, std::move(value));
          });
        else
          walk(child, place);
      }
    } else if (toml::array* array = node.as_array()) {
      walkArray(*array, path);
    }
  }

  NumberTolerances found;

 private:
  static bool isStated(const toml::node& node) { return node.is_table() && node.as_table()->contains("value"); }

  void walkArray(toml::array& array, const std::string& path) {
    for (std::size_t k = 0; k < array.size(); ++k) {
      toml::node& child = *array.get(k);
      if (isStated(child))
        taken(child, fmt::format("{}.{}", path, k)).visit([&](auto& value) {
          array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(k), std::move(value));
        });
      else
        walk(child, fmt::format("{}.{}", path, k + 1));
    }
  }

  /// Notes the tolerance of a table that has `value` and `tolerance`, and returns its value.
  toml::node& taken(toml::node& node, const std::string& path) {
    toml::table& table = *node.as_table();
    for (const auto& [key, child] : table)
      if (key.str() != "value" && key.str() != "tolerance")
        throw errorAt(file_, key.source().begin,
                      fmt::format("unknown key '{}' in {}, expected 'value' or 'tolerance'",
                                  shown(std::string(key.str())), path));
    if (!table.contains("tolerance"))
      throw errorAt(file_, table.source().begin, fmt::format("missing key 'tolerance' in {}, expected a number", path));
    toml::node& value = *table.get("value");
    const toml::node& tolerance = *table.get("tolerance");
    const toml::array* values = value.as_array();
    if (values == nullptr)
      note(tolerance, path, path);
    else
      noteAll(*values, tolerance, path);
    return value;
  }

  void noteAll(const toml::array& values, const toml::node& tolerance, const std::string& path) {
    const toml::array* each = tolerance.as_array();
    if (each != nullptr && each->size() != values.size())
      throw errorAt(
          file_, tolerance.source().begin,
          fmt::format("{}.tolerance: an array of {}, expected one number or {}", path, each->size(), values.size()));
    for (std::size_t k = 0; k < values.size(); ++k)
      note(each == nullptr ? tolerance : *each->get(k), path, fmt::format("{}.{}", path, k));
  }

  void note(const toml::node& tolerance, const std::string& path, const std::string& of) {
    const auto value = tolerance.is_number() ? tolerance.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < 0)
      throw errorAt(file_, tolerance.source().begin, path + ".tolerance: expected a finite number >= 0");
    found[of] = *value;
  }

  const std::string& file_;
};

/// Returns whether the document has the key at the end of `parts`, under either name.
bool gives(const toml::node* at, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    const toml::table* table = at == nullptr ? nullptr : at->as_table();
    if (table == nullptr) return at != nullptr && at->is_array();
    at = table->get(table->contains(part) ? part : otherFrictionName(part));
  }
  return at != nullptr;
}

std::optional<double> lookUp(const NumberTolerances& raw, const std::string& path) {
  if (const auto at = raw.find(path); at != raw.end()) return at->second;
  const auto dot = path.rfind('.');
  const auto other = raw.find(path.substr(0, dot + 1) + otherFrictionName(path.substr(dot + 1)));
  if (other != raw.end()) return other->second;
  return std::nullopt;
}

/// The document may give a mass centre on the link's line as three numbers.
std::optional<double> lookUp(const NumberTolerances& raw, const MachineNumber& number, const std::string& path,
                             const Leg& leg) {
  if (const auto found = lookUp(raw, path); found || number.quantity != Quantity::center) return found;
  return lookUp(raw, fmt::format("{}.{}", path, number.body == NumberBody::proximal ? leg.proximalLine() : 2));
}

std::vector<std::string> afterLeg(const std::string& path) {
  std::vector<std::string> out;
  std::size_t begin = std::string("manipulator.leg.").size() + 2;  // legs have one digit
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    out.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

}  // namespace

NumberTolerances takeTolerances(toml::table& document, const std::string& file) {
  ToleranceTaker taker(file);
  taker.walk(document, "");
  return std::move(taker.found);
}

NumberTolerances statedTolerances(const Scenario& scenario) {
  if (!scenario.isAsRead()) return {};
  toml::table document = parseToml(scenario.text, scenario.file.string());
  const NumberTolerances raw = takeTolerances(document, scenario.file.string());
  NumberTolerances out;
  if (raw.empty()) return out;
  const ManipulatorParameters& machine = scenario.manipulator->given();
  const toml::array* legs = document["manipulator"]["leg"].as_array();
  for (const MachineNumber& number : machineNumbers(machine)) {
    const std::size_t i = std::max(number.leg, 0);
    std::optional<double> found = lookUp(raw, number, number.path, machine.legs[i]);
    if (!found && number.leg >= 0) {
      const std::vector<std::string> parts = afterLeg(number.path);
      if (!gives(legs->get(i), parts))
        found = lookUp(raw, number, fmt::format("manipulator.leg_defaults.{}", fmt::join(parts, ".")), machine.legs[i]);
    }
    if (found) out[number.path] = *found;
  }
  return out;
}

}  // namespace ursula
