#include "model/scenario_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "model/mechanism_keys.h"
#include "model/scenario_keys.h"

namespace ursula {
namespace {

/// Splits at dots; a part that contains dots, such as a check's name, is written "as.this".
std::vector<std::string> partsOf(const std::string& key) {
  std::vector<std::string> parts(1);
  bool is_quoted = false;
  for (const char c : key) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == '.' && !is_quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

bool isTop(const std::string& part) {
  const std::vector<std::string> top = scenarioTable("").names();
  return std::find(top.begin(), top.end(), part) != top.end();
}

std::string withManipulator(const std::string& key) {
  const std::string first = partsOf(key).front();
  const std::vector<std::string> machine = scenarioTable("manipulator").names();
  const bool of_machine = std::find(machine.begin(), machine.end(), first) != machine.end();
  return !isTop(first) && of_machine ? "manipulator." + key : key;
}

/// A position on the path from the document to a number, with its fallback and its allowed content.
struct Spot {
  toml::node* node;
  const toml::node* inherited;  ///< the same node in leg_defaults; null if there is none
  std::string table;            ///< name in scenarioTables(), if `node` is a table or an array of tables
  bool integer = false;
  bool mechanism = false;  ///< of a scenario with [mechanism]
};

[[noreturn]] void fail(const std::string& key, const std::string& what) {
  throw NumberKeyError(fmt::format("'{}': {}", key, what));
}

const ScenarioTable& keysOf(const Spot& spot) {
  const bool own = spot.mechanism && spot.table != "simulation" && spot.table.compare(0, 10, "acceptance") != 0;
  const auto table = [own](const std::string& name) -> const ScenarioTable& {
    return own ? mechanismTable(name) : scenarioTable(name);
  };
  if (spot.table != "trajectory") return table(spot.table);
  const std::string kind = spot.node->as_table()->get("kind")->value_or(std::string());
  return table("trajectory." + kind);
}

std::string childTable(const std::string& key, const ScenarioKey& about) {
  if (about.of[0] != '\0') return about.of;
  return key == "trajectory" ? "trajectory" : "";
}

/// Writes a missing key: the value of the leg's defaults, else the program's default; a table is made empty.
void writeOut(toml::table& table, const ScenarioKey& about, const toml::node* inherited, const std::string& whole) {
  if (about.type == KeyType::table) {
    table.insert(about.name, toml::table{});
    return;
  }
  if (inherited != nullptr) {
    inherited->visit([&](const auto& value) { table.insert(about.name, value); });
    return;
  }
  if (about.isRequired() || about.fallback[0] == '\0')
    fail(whole, fmt::format("the scenario does not give '{}', and it has no default", about.name));
  toml::table parsed = toml::parse(fmt::format("value = {}", about.fallback));
  parsed.get("value")->visit([&](auto& value) { table.insert(about.name, std::move(value)); });
}

/// Friction has two names on the paper's legs. Returns the one that the leg or its defaults use, otherwise `part`.
std::string asWritten(const Spot& spot, const std::string& part) {
  const bool of_friction = spot.table == "manipulator.leg.friction" || spot.table == "manipulator.leg.coulomb";
  const std::string other = of_friction ? otherFrictionName(part) : "";
  if (other.empty()) return part;
  for (const toml::node* node : {static_cast<const toml::node*>(spot.node), spot.inherited}) {
    const toml::table* table = node == nullptr ? nullptr : node->as_table();
    if (table != nullptr && (table->contains(part) || table->contains(other)))
      return table->contains(part) ? part : other;
  }
  return part;
}

Spot intoTable(const Spot& spot, const std::string& asked, const std::string& whole) {
  const std::string part = asWritten(spot, asked);
  // Keys of limits are names of checks, dotted or in tables; only those in the scenario can vary.
  if (spot.table.compare(0, 10, "acceptance") == 0 || spot.table == "mechanism.numbers")
    if (toml::node* given = spot.node->as_table()->get(part))
      return {given, nullptr, "acceptance", false, spot.mechanism};
  const ScenarioTable& keys = keysOf(spot);
  const std::vector<std::string> names = keys.names();
  if (std::find(names.begin(), names.end(), part) == names.end())
    fail(whole, fmt::format("no key '{}' in {}, expected one of {}{}", part, keys.written, fmt::join(names, ", "),
                            didYouMean(part, names)));
  const ScenarioKey& about = keys.key(part);
  const toml::table* defaults = spot.inherited == nullptr ? nullptr : spot.inherited->as_table();
  const toml::node* inherited = defaults == nullptr ? nullptr : defaults->get(part);
  toml::table& table = *spot.node->as_table();
  if (!table.contains(part)) writeOut(table, about, inherited, whole);
  return {table.get(part), inherited, childTable(part, about), about.type == KeyType::integer, spot.mechanism};
}

std::size_t indexOf(const std::string& part, std::size_t from, std::size_t size, const std::string& whole) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error != std::errc() || end != part.data() + part.size() || part != std::to_string(index) || index < from ||
      index - from >= size)
    fail(whole, fmt::format("'{}', expected an index from {} to {}", part, from, from + size - 1));
  return index - from;
}

Spot intoArray(const Spot& spot, const std::string& part, const std::string& whole, const toml::table& document) {
  toml::array& array = *spot.node->as_array();
  const bool of_tables = !array.empty() && array.front().is_table();
  const std::size_t index = indexOf(part, of_tables ? 1 : 0, array.size(), whole);
  Spot out{array.get(index), nullptr, spot.table, false, spot.mechanism};
  if (spot.table == "manipulator.leg") out.inherited = document["manipulator"]["leg_defaults"].node();
  return out;
}

Spot into(const Spot& spot, const std::string& part, const std::string& whole, const toml::table& document) {
  if (spot.node->is_table() && (!spot.table.empty() || spot.node == &document)) return intoTable(spot, part, whole);
  if (spot.node->is_array()) return intoArray(spot, part, whole, document);
  fail(whole, fmt::format("there is nothing '{}' within what comes before it", part));
}

/// Follows the first `count` parts.
Spot follow(toml::table& document, const std::vector<std::string>& parts, std::size_t count, const std::string& whole) {
  Spot spot{&document, nullptr, "", false, document.contains("mechanism")};
  for (std::size_t k = 0; k < count; ++k) spot = into(spot, parts[k], whole, document);
  return spot;
}

/// Replaces the integer 5 by 5.0; other nodes of the table stay valid.
toml::node* asFloat(toml::node& parent, const std::string& part, const toml::node& number) {
  const double value = *number.value<double>();
  if (toml::array* array = parent.as_array()) return &*array->replace(array->cbegin() + std::stol(part), value);
  return &parent.as_table()->insert_or_assign(part, value).first->second;
}

/// Refuses a default that every leg overrides, because it would change nothing.
void requireUse(const toml::table& document, const std::string& whole) {
  const std::vector<std::string> parts = partsOf(whole);
  const toml::array* legs = document["manipulator"]["leg"].as_array();
  if (parts.size() < 3 || parts[0] != "manipulator" || parts[1] != "leg_defaults" || legs == nullptr) return;
  const auto overrides = [&](const toml::node& leg) {
    const toml::node* at = &leg;
    for (std::size_t k = 2; k < parts.size() && at != nullptr && at->is_table(); ++k) {
      const toml::table& table = *at->as_table();
      at = table.get(table.contains(parts[k]) ? parts[k] : otherFrictionName(parts[k]));
    }
    return at != nullptr;
  };
  if (std::all_of(legs->begin(), legs->end(), overrides))
    fail(whole, "every leg gives its own, expected 'manipulator.leg.*' in place of 'manipulator.leg_defaults'");
}

}  // namespace

std::vector<std::string> ScenarioNumbers::expanded(const std::string& key) const {
  const std::string whole = document_.contains("mechanism") ? key : withManipulator(key);
  const std::vector<std::string> parts = partsOf(whole);
  const auto star = std::find(parts.begin(), parts.end(), "*");
  if (star == parts.end()) return {whole};
  const std::size_t before = star - parts.begin();
  const auto with = [&](std::size_t index) {
    std::vector<std::string> out = parts;
    out[before] = std::to_string(index);
    return fmt::format("{}", fmt::join(out, "."));
  };
  toml::table scratch = document_;  // receives the inherited numbers
  const toml::array* array = follow(scratch, parts, before, whole).node->as_array();
  if (array == nullptr || array->empty()) fail(key, "'*' stands for no array, expected legs or entries");
  const std::size_t first = array->front().is_table() ? 1 : 0;
  std::vector<std::string> out;
  for (std::size_t k = 0; k < array->size(); ++k)
    for (std::string& each : expanded(with(first + k))) out.push_back(std::move(each));
  return out;
}

double ScenarioNumbers::hold(const std::string& key) {
  const std::vector<std::string> parts = partsOf(key);
  const Spot parent = follow(document_, parts, parts.size() - 1, key);
  Spot spot = into(parent, parts.back(), key, document_);
  if (!spot.node->is_number())
    fail(key, spot.node->is_array() || spot.node->is_table()
                  ? "has numbers within it, expected the key of one, such as '" + key + ".0'"
                  : "is not a number");
  requireUse(document_, key);
  if (spot.node->is_integer() && !spot.integer) spot.node = asFloat(*parent.node, parts.back(), *spot.node);
  held_.push_back({key, spot.node});
  return *spot.node->value<double>();
}

void ScenarioNumbers::set(std::size_t k, double value) {
  const Held& held = held_[k];
  if (toml::value<double>* number = held.node->as_floating_point()) {
    *number = value;
    return;
  }
  if (value != std::floor(value) || std::abs(value) > 1e9)
    fail(held.key, fmt::format("{}, expected an integer", value));
  *held.node->as_integer() = static_cast<std::int64_t>(value);
}

}  // namespace ursula
