#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/text_source.h"
#include "model/scenario_sections.h"
#include "model/trajectories/trajectory_kinds.h"

namespace ursula {
namespace {

constexpr std::size_t most_errors = 10;
/// The bound of this number depends on the kind of the leg: a carriage's length may be zero.
constexpr std::string_view by_kind = "length";

/// Compares a document with the table of keys. Tables whose keys are names of checks are the reader's alone.
class KeyErrors {
 public:
  explicit KeyErrors(const PlacedError& first) : errors({first}) {}

  void addAll(const TomlSection& section, const ScenarioTable& keys) {
    for (const PlacedError& each : section.unknownKeys(keys)) add(each);
    for (const ScenarioKey& key : keys.keys) {
      try {
        if (section.has(key.name)) read(section, key);
      } catch (const PlacedError& error) {
        add(error);
      }
    }
  }

  std::vector<PlacedError> errors;

 private:
  /// A value has one error; the reader's own words for it come first.
  void add(const PlacedError& error) {
    const auto is_known = [&](const PlacedError& other) {
      return other.what() == std::string(error.what()) ||
             (other.position() == error.position() && other.position().first > 1);
    };
    if (std::none_of(errors.begin(), errors.end(), is_known)) errors.push_back(error);
  }

  void read(const TomlSection& section, const ScenarioKey& key) {
    double number = 0;
    int integer = 0;
    Vector3d vector;
    Matrix3d inertia;
    std::string text;
    switch (key.type) {
      case KeyType::number:
        section.read(key.name, number);
        if (key.name != by_kind) section.requireBound(key, number);
        return;
      case KeyType::integer:
        section.read(key.name, integer);
        return section.requireBound(key, integer);
      case KeyType::string:
        return static_cast<void>(section.read(key.name, text));
      case KeyType::choice:
        return static_cast<void>(section.readChoice(key));
      case KeyType::choices:
        return static_cast<void>(section.readStrings(key.name));
      case KeyType::center:
        if (!section.table().get(key.name)->is_array()) return static_cast<void>(section.read(key.name, number));
        return static_cast<void>(section.read(key.name, vector));
      case KeyType::vector:
        return static_cast<void>(section.read(key.name, vector));
      case KeyType::quaternion:
        return static_cast<void>(readOrientation(section));
      case KeyType::inertia:
        return static_cast<void>(section.readInertia(key.name, inertia));
      case KeyType::table:
        return addTable(*section.section(key.name), key.of);
      case KeyType::tables:
        for (const TomlSection& each : section.sections(key.name)) addAll(each, scenarioTable(key.of));
        return;
      case KeyType::share:
      case KeyType::numbers:
      case KeyType::limits:
        return;
    }
  }

  void addTable(const TomlSection& section, const std::string& name) {
    if (name == "acceptance") return;
    if (name != "trajectory") return addAll(section, scenarioTable(name));
    if (const auto kind = section.readChoice(scenarioTable(name).key("kind")))
      addAll(section, scenarioTable(name + "." + trajectory_kinds[*kind].name));
  }
};

}  // namespace

PlacedError PlacedError::together(const std::vector<PlacedError>& errors) {
  std::string what, at_length;
  for (const PlacedError& each : errors) {
    what += std::string(what.empty() ? "" : "\n") + each.what();
    at_length += std::string(at_length.empty() ? "" : "\n") + ursula::atLength(each);
  }
  PlacedError out(what, errors.front().line_, errors.front().column_);
  out.at_length_ = at_length;
  return out;
}

PlacedError PlacedError::in(const std::string& text) const {
  PlacedError out = *this;
  const std::string excerpt = line_ > 0 ? excerptOf(text, line_, column_) : "";
  if (out.at_length_.empty() && !excerpt.empty()) out.at_length_ = what() + ("\n" + excerpt);
  return out;
}

std::string atLength(const ScenarioError& error) {
  const auto* placed = dynamic_cast<const PlacedError*>(&error);
  return placed == nullptr || placed->atLength().empty() ? error.what() : placed->atLength();
}

PlacedError withOthers(const PlacedError& first, const TomlSection& document, const std::string& text) {
  KeyErrors all(first);
  all.addAll(document, scenarioTable(""));
  std::stable_sort(all.errors.begin(), all.errors.end(),
                   [](const PlacedError& a, const PlacedError& b) { return a.position() < b.position(); });
  const std::size_t more = all.errors.size() - std::min(all.errors.size(), most_errors);
  all.errors.resize(all.errors.size() - more, first);
  for (PlacedError& each : all.errors) each = each.in(text);
  if (more > 0) all.errors.emplace_back(fmt::format("and {} more error{}", more, more == 1 ? "" : "s"), 0, 0);
  return PlacedError::together(all.errors);
}

}  // namespace ursula
