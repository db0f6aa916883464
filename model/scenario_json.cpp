#include "model/scenario_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "base/text.h"
#include "model/scenario_files.h"
#include "model/toml_reader.h"
#include "model/toml_writer.h"

namespace ursula {
namespace {

using Json = nlohmann::json;

/// Scenarios hold no dates: their parser has refused them.
Json jsonOf(const toml::node& node) {
  if (const toml::table* table = node.as_table()) {
    Json out = Json::object();
    for (const auto& [key, value] : *table) out[std::string(key.str())] = jsonOf(value);
    return out;
  }
  if (const toml::array* array = node.as_array()) {
    Json out = Json::array();
    for (const toml::node& value : *array) out.push_back(jsonOf(value));
    return out;
  }
  if (node.is_integer()) return node.as_integer()->get();
  if (node.is_floating_point()) return node.as_floating_point()->get();
  if (node.is_boolean()) return node.as_boolean()->get();
  return node.value_or(std::string());
}

/// Converts a JSON document into TOML tables and arrays; `put` stores each value under its key.
class Translation {
 public:
  explicit Translation(std::string file) : file_(std::move(file)) {}

  toml::table table(const Json& object, const std::string& place) const {
    toml::table out;
    for (const auto& [key, value] : object.items())
      convert(value, place.empty() ? key : place + "." + key,
              [&out, &name = key](auto&& node) { out.insert_or_assign(name, std::forward<decltype(node)>(node)); });
    return out;
  }

 private:
  template <class Put>
  void convert(const Json& value, const std::string& place, const Put& put) const {
    if (value.is_object()) return put(table(value, place));
    if (value.is_array()) return put(array(value, place));
    if (value.is_string()) return put(value.get<std::string>());
    if (value.is_boolean()) return put(value.get<bool>());
    if (value.is_number_integer() && !value.is_number_unsigned()) return put(value.get<std::int64_t>());
    if (value.is_number_unsigned() && value.get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max())
      return put(static_cast<std::int64_t>(value.get<std::uint64_t>()));
    if (value.is_number()) return put(value.get<double>());
    throw ScenarioError(fmt::format("{}: error: {}: null, expected a value, or no such key", file_, shown(place)));
  }

  toml::array array(const Json& values, const std::string& place) const {
    toml::array out;
    for (const Json& value : values)
      convert(value, fmt::format("{}[{}]", place, out.size() + 1),
              [&out](auto&& node) { out.push_back(std::forward<decltype(node)>(node)); });
    return out;
  }

  std::string file_;
};

}  // namespace

std::string scenarioJson(const Scenario& scenario) {
  if (!scenario.isAsRead())
    throw ScenarioError(fmt::format("{}: error: a scenario that a program made has no document", scenario.name));
  return scenarioJson(scenario.text, scenario.file);
}

std::string scenarioJson(const std::string& text, const std::filesystem::path& file) {
  toml::table document = parseToml(text, file.string());
  makeFilesAbsolute(document, file);
  return jsonText(jsonOf(document));
}

std::string tomlOfJson(const std::string& json, const std::filesystem::path& file) {
  const std::string shown_file = shownPath(file.string());
  try {
    const Json document = Json::parse(json);
    if (!document.is_object()) throw ScenarioError(shown_file + ": error: expected an object of JSON");
    return tomlText(Translation(shown_file).table(document, ""));
  } catch (const Json::exception& error) {
    throw ScenarioError(fmt::format("{}: error: {}, expected valid JSON", shown_file, shown(error.what(), 400)));
  }
}

}  // namespace ursula
