#include "parts/scenario_docs/scenario_docs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/mechanism_keys.h"
#include "model/scenario_keys.h"

namespace ursula {
namespace {

constexpr const char* opening = R"(# Scenarios

A scenario is one TOML file. It has either `[manipulator]`, six motors on legs, or `[mechanism]`, a model file with [any closed loop](#any-closed-loop). This page is made by `./dev docs` from the tables that the reader itself goes by (`model/scenario_keys.cpp`, `model/mechanism_keys.cpp`);
[scenario.schema.json](scenario.schema.json) is the same for editors: with Taplo (Even Better TOML), `#:schema PATH` as the first line
of a file switches it on. `ursula init` writes that line with the path of the installed file, if there is one. `ursula init FILE.toml --kind UPS` (or URS, RUS, PUS) writes a scenario to start from, `ursula init FILE.toml --model MODEL` one of a model file, `ursula check FILE.toml` says what is wrong or odd in one.

A key that is not here is an error, and so is a value of another type. Numbers may be written as integers and must be finite. A key without a default is
required, unless "Default" is a dash.

## Angles

Angles are in radians. Where a key ends in `_deg` it is in degrees and stands for the key of the same name without it; giving both is an error, and nothing is
guessed. An orientation is a unit quaternion `[w, x, y, z]`, or `rpy_deg = [roll, pitch, yaw]` in degrees: turns about the **fixed** axes x, y and z of B, in
this order, Q = R_z(yaw) R_y(pitch) R_x(roll). (About moving axes the same is yaw about z first, then pitch about y, then roll about x.) Degrees are converted
with one rounding: 90 is the double nearest to π/2.

## Tolerances

Wherever a number stands, `{ value = 10.0, tolerance = 0.05 }` says how well it is known; so does `{ value = [0.0, 0.0, 1.88], tolerance = 0.01 }` of an array, with one tolerance for
all its entries or an array of them. A tolerance is a standard uncertainty in the number's unit: the true number is within it in 68 %, within twice of it in 95 % of all cases. Of limits ±a that
are never passed, a/√3 is the tolerance. `ursula identify` judges measured efforts by those of the machine ([identify.md](identify.md)); everything else takes the value.
)";

std::string typeWords(const ScenarioKey& key) {
  switch (key.type) {
    case KeyType::number:
      return "number";
    case KeyType::share:
      return "number or percentage";
    case KeyType::integer:
      return "integer";
    case KeyType::string:
      return "string";
    case KeyType::choice:
      return fmt::format("`\"{}\"`", fmt::join(key.choices, "\"`, `\""));
    case KeyType::choices:
      if (key.choices.empty()) return "array of strings";
      return fmt::format("array of `\"{}\"`", fmt::join(key.choices, "\"`, `\""));
    case KeyType::vector:
      return "3 numbers";
    case KeyType::numbers:
      return "array of numbers";
    case KeyType::quaternion:
      return "4 numbers";
    case KeyType::center:
      return "number or 3 numbers";
    case KeyType::inertia:
      return "3 or 6 numbers";
    case KeyType::tables:
      return "array of tables";
    case KeyType::table:
    case KeyType::limits:
      break;
  }
  return "table";
}

std::string orDash(const std::string& text) { return text.empty() ? "–" : text; }

std::string defaultOf(const ScenarioKey& key) {
  if (key.isRequired()) return "required";
  return key.fallback[0] == '\0' ? "–" : fmt::format("`{}`", key.fallback);
}

std::string row(const ScenarioKey& key) {
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, typeWords(key), orDash(key.unit), defaultOf(key),
                     orDash(key.bound.words), orDash(key.meaning));
}

constexpr const char* loops = R"(
## Any closed loop

[Your mechanism](mechanism.md) leads from a model file to a verdict. A scenario with `[mechanism]` has these tables. `[simulation]` and `[acceptance]` are the same as above.

Motors' coordinates are those of the model file: zero where the file's coordinate is zero, growing as its axis says. There are as many motors as freedoms.
)";

std::string section(const ScenarioTable& table, const char* level) {
  std::string out =
      fmt::format("\n{} {}\n\n", level, table.name[0] == '\0' ? table.written : fmt::format("`{}`", table.written));
  if (table.meaning[0] != '\0') out += fmt::format("{}\n\n", table.meaning);
  out += "| key | type | unit | default | bound | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ScenarioKey& key : table.keys) out += row(key);
  return out;
}

}  // namespace

std::string scenarioMarkdown() {
  std::string out = opening;
  for (const ScenarioTable& table : scenarioTables()) out += section(table, "##");
  out += loops;
  for (const ScenarioTable& table : mechanismTables()) out += section(table, "###");
  return out;
}

namespace {

using Json = nlohmann::ordered_json;

/// Finds a table of one kind of scenario by its name.
using Find = const ScenarioTable& (*)(std::string_view);

Json schemaOf(const ScenarioTable& table, Find find);

Json arrayOf(int least, int most) { return {{"$ref", "#/$defs/numbers"}, {"minItems", least}, {"maxItems", most}}; }

/// Returns the definitions of a number and an array of numbers, each plain or in a table with its tolerance.
Json definitions() {
  const Json number = {{"$ref", "#/$defs/number"}};
  const Json tolerance = {{"anyOf", {Json{{"type", "number"}}, Json{{"type", "array"}}}}};
  const Json known = {{"required", {"value", "tolerance"}},
                      {"properties", {{"value", Json::object()}, {"tolerance", tolerance}}}};
  Json one = {{"type", {"number", "object"}}}, many = {{"type", {"array", "object"}}, {"items", number}};
  one.update(known);
  many.update(known);
  return {{"number", one}, {"numbers", many}};
}

/// Converts a bound of the table: > 0 means at least the smallest positive number.
void addBound(const KeyBound& bound, Json& out) {
  if (std::fpclassify(bound.least) == FP_SUBNORMAL)
    out["exclusiveMinimum"] = 0;
  else if (bound.zero_too && std::isfinite(bound.least))
    out["minimum"] = bound.least;
  if (bound.zero_too && std::isfinite(bound.most)) out["maximum"] = bound.most;
  if (!bound.zero_too) out["not"] = {{"const", 0}};
}

Json typeOf(const ScenarioKey& key, Find find) {
  switch (key.type) {
    case KeyType::number:
      return {{"$ref", "#/$defs/number"}};
    case KeyType::share:
      return {{"anyOf", {Json{{"$ref", "#/$defs/number"}}, Json{{"type", "string"}, {"pattern", "^[^%]+%$"}}}}};
    case KeyType::integer:
      return {{"type", "integer"}};
    case KeyType::string:
      return {{"type", "string"}};
    case KeyType::choice:
      return {{"enum", key.choices}};
    case KeyType::choices:
      if (key.choices.empty()) return {{"type", "array"}, {"items", {{"type", "string"}}}};
      return {{"type", "array"}, {"items", {{"enum", key.choices}}}, {"uniqueItems", true}};
    case KeyType::vector:
      return arrayOf(3, 3);
    case KeyType::numbers:
      return {{"type", "array"}, {"items", {{"type", "number"}}}};
    case KeyType::quaternion:
      return arrayOf(4, 4);
    case KeyType::center:
      return {{"anyOf", {Json{{"$ref", "#/$defs/number"}}, arrayOf(3, 3)}}};
    case KeyType::inertia:
      return {{"anyOf", {arrayOf(3, 3), arrayOf(6, 6)}}};
    case KeyType::tables:
      return {{"type", "array"}, {"items", schemaOf(find(key.of), find)}};
    case KeyType::limits:
    case KeyType::table:
      break;
  }
  return schemaOf(find(key.of), find);
}

std::string description(const ScenarioKey& key) {
  const std::string unit = key.unit;
  return std::string(key.meaning) + (unit.empty() ? "" : (key.meaning[0] == '\0' ? "" : ", ") + unit);
}

Json schemaOf(const ScenarioKey& key, Find find) {
  Json out = typeOf(key, find);
  addBound(key.bound, out);
  if (const std::string text = description(key); !text.empty()) out["description"] = text;
  if (key.fallback[0] != '\0' && !key.isRequired()) out["default"] = Json::parse(key.fallback);
  return out;
}

/// Returns the alternative of a key, in degrees or another form. One of the two is required; both together are an
/// error.
const char* alternativeTo(const ScenarioTable& table, const std::string& name) {
  for (const ScenarioKey& key : table.keys)
    if (key.name == name + "_deg" || (name == "orientation" && key.name == std::string("rpy_deg"))) return key.name;
  return nullptr;
}

/// Whether the table's required keys may be in the legs' defaults instead, because an editor sees one table at a time.
bool mayBeElsewhere(const ScenarioTable& table) {
  return table.name == std::string("manipulator.leg") || table.name == std::string("manipulator.leg.link");
}

Json plainSchemaOf(const ScenarioTable& table, Find find) {
  Json out = {{"type", "object"}, {"additionalProperties", false}};
  Json properties = Json::object(), required = Json::array(), all = Json::array();
  for (const ScenarioKey& key : table.keys) {
    properties[key.name] = schemaOf(key, find);
    const char* other = alternativeTo(table, key.name);
    if (other != nullptr) {
      const Json first = {{"required", {key.name}}}, second = {{"required", {other}}};
      all.push_back(key.isRequired() ? Json{{"oneOf", {first, second}}}
                                     : Json{{"not", {{"required", {key.name, other}}}}});
    } else if (key.isRequired() && !mayBeElsewhere(table)) {
      required.push_back(key.name);
    }
  }
  out["properties"] = properties;
  if (!required.empty()) out["required"] = required;
  if (!all.empty()) out["allOf"] = all;
  return out;
}

/// Returns the schema of [trajectory]: one of its kinds.
Json kindsOf(const ScenarioTable& trajectory, Find find) {
  Json out = {{"type", "object"}, {"oneOf", Json::array()}};
  for (const std::string& kind : trajectory.key("kind").choices) {
    Json each = plainSchemaOf(find("trajectory." + kind), find);
    each["properties"]["kind"] = {{"const", kind}};
    out["oneOf"].push_back(each);
  }
  return out;
}

Json schemaOf(const ScenarioTable& table, Find find) {
  if (table.name == std::string("trajectory")) return kindsOf(table, find);
  Json out = plainSchemaOf(table, find);
  const bool by_name = table.name == std::string("acceptance") || table.name == std::string("mechanism.numbers");
  if (by_name)  // names of checks, bodies and joints may be dotted keys and thus tables
    out["additionalProperties"] = {{"type", {"number", "object"}}};
  if (table.name == std::string("acceptance.torque")) out["additionalProperties"] = {{"type", {"number", "object"}}};
  return out;
}

/// Lets a document have [mechanism], with a motion of its motors, instead of [manipulator].
void addMechanism(Json& out) {
  const Json platforms = out["properties"]["trajectory"];
  const Json motors = schemaOf(mechanismTable("trajectory"), &mechanismTable);
  out["properties"]["mechanism"] = schemaOf(mechanismTable("mechanism"), &mechanismTable);
  out["properties"]["trajectory"] = {{"anyOf", {platforms, motors}}};
  out["required"] = {"name", "trajectory"};
  const Json of_mechanism = {{"required", {"mechanism"}}}, of_manipulator = {{"required", {"manipulator"}}};
  out["oneOf"] = {of_manipulator, of_mechanism};
  out["if"] = of_mechanism;
  out["then"] = {{"properties", {{"trajectory", motors}, {"load", false}}}};
  out["else"] = {{"properties", {{"trajectory", platforms}}}};
}

}  // namespace

std::string scenarioSchema() {
  Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "A scenario of ursula"},
              {"description", scenarioTable("").meaning},
              {"$defs", definitions()}};
  out.update(schemaOf(scenarioTable(""), &scenarioTable));
  out["properties"]["manipulator"]["properties"]["leg"]["minItems"] = 3;
  out["properties"]["manipulator"]["properties"]["leg"]["maxItems"] = 6;
  addMechanism(out);
  return out.dump(2) + "\n";
}

}  // namespace ursula
