#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/scenario_keys.h"
#include "studies/scenario_docs/scenario_docs.h"

namespace ursula {
namespace {

constexpr const char* opening = R"(# Scenarios

A scenario is one TOML file. This page is made by `./dev docs` from the table that the reader itself goes by (`model/scenario_keys.cpp`);
[scenario.schema.json](scenario.schema.json) is the same for editors: with Taplo (Even Better TOML), `#:schema docs/scenario.schema.json` as the first line
of a file switches it on. `ursula init FILE.toml --kind UPS` (or URS, RUS, PUS) writes a scenario to start from, `ursula check FILE.toml` says what is wrong or odd in one.

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
      return fmt::format("array of `\"{}\"`", fmt::join(key.choices, "\"`, `\""));
    case KeyType::vector:
      return "3 numbers";
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

}  // namespace

std::string scenarioMarkdown() {
  std::string out = opening;
  for (const ScenarioTable& table : scenarioTables()) {
    out += fmt::format("\n## {}\n\n", table.name[0] == '\0' ? table.written : fmt::format("`{}`", table.written));
    if (table.meaning[0] != '\0') out += fmt::format("{}\n\n", table.meaning);
    out += "| key | type | unit | default | bound | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
    for (const ScenarioKey& key : table.keys) out += row(key);
  }
  return out;
}

}  // namespace ursula
