#include "model/scenario_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "model/scenario_files.h"
#include "model/scenario_keys.h"
#include "model/scenario_sections.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

/// Returns the names of the keys that are lengths. A name has the same unit in every table.
std::set<std::string_view> lengthKeys() {
  std::set<std::string_view> out;
  for (const ScenarioTable& table : scenarioTables())
    for (const ScenarioKey& key : table.keys)
      if (const std::string_view unit = key.unit; unit == "m" || unit == "m/rad") out.insert(key.name);
  return out;
}

/// Collects all numbers below a node.
void numbersBelow(const toml::node& node, std::vector<const toml::node*>& out) {
  if (node.is_number()) out.push_back(&node);
  if (const toml::array* array = node.as_array())
    for (const toml::node& each : *array) numbersBelow(each, out);
  if (const toml::table* table = node.as_table())
    for (const auto& [key, each] : *table) numbersBelow(each, out);
}

void lengthsBelow(const toml::node& node, const std::set<std::string_view>& lengths,
                  std::vector<const toml::node*>& out) {
  if (const toml::array* array = node.as_array())
    for (const toml::node& each : *array) lengthsBelow(each, lengths, out);
  if (const toml::table* table = node.as_table())
    for (const auto& [key, each] : *table)
      lengths.count(key.str()) != 0 ? numbersBelow(each, out) : lengthsBelow(each, lengths, out);
}

/// Returns the byte at a place; TOML counts lines and characters from 1.
std::size_t offsetOf(const std::string& text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  const auto follows = [&](std::size_t k) {
    return k < text.size() && (static_cast<unsigned char>(text[k]) & 0xC0) == 0x80;
  };
  for (toml::source_index column = 1; column < place.column; ++column) {
    ++at;
    while (follows(at)) ++at;
  }
  return at;
}

}  // namespace

std::string withLengthsInMetres(int per_metre, const std::filesystem::path& file) {
  const std::string text = scenarioText(file);
  const toml::table document = parseToml(text, file.string());
  requireManipulator(TomlSection(document, "", file.string()));
  std::vector<const toml::node*> numbers;
  lengthsBelow(document, lengthKeys(), numbers);
  const auto begins = [](const toml::node* node) { return node->source().begin; };
  std::sort(numbers.begin(), numbers.end(), [&](auto* a, auto* b) { return begins(a) < begins(b); });
  std::string out;
  std::size_t taken = 0;
  for (const toml::node* number : numbers) {
    const toml::source_region place = number->source();
    const std::size_t begin = offsetOf(text, place.begin);
    out += text.substr(taken, begin - taken) + fmt::format("{}", *number->value<double>() / per_metre);
    taken = offsetOf(text, place.end);
  }
  return out + text.substr(taken);
}

}  // namespace ursula
