#include "parts/sweep/sweep_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text.h"
#include "base/toml_bounds.h"
#include "model/toml_reader.h"

namespace ursula {
namespace {

constexpr int most_values = 1'000'000;

const ScenarioTable& keysOfDocument() { return sweepTables()[0]; }

std::vector<double> numbers(const TomlSection& table, const std::string& key) {
  const toml::array* array = table.table().get(key)->as_array();
  if (array == nullptr || array->empty()) table.fail(key, "expected an array of numbers");
  if (array->size() > most_values)
    table.fail(key, fmt::format("{} numbers, expected at most {}", array->size(), most_values));
  std::vector<double> out;
  for (const toml::node& element : *array) {
    const std::optional<double> value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value))
      table.fail(key, fmt::format("entry {}, expected a finite number", out.size() + 1));
    out.push_back(*value);
  }
  return out;
}

std::vector<double> pair(const TomlSection& table, const std::string& key, const char* what) {
  std::vector<double> out = numbers(table, key);
  if (out.size() != 2)
    table.fail(key, fmt::format("{} number{}, expected {}", out.size(), out.size() == 1 ? "" : "s", what));
  return out;
}

Variation stepsOf(const TomlSection& table) {
  const std::vector<double> given = numbers(table, "steps");
  if (given.size() != 3 || given[2] != std::floor(given[2]) || !(given[2] >= 2 && given[2] <= most_values))
    table.fail("steps", fmt::format("expected [from, to, count], count an integer from 2 to {}", most_values));
  Variation out;
  const auto count = static_cast<int>(given[2]);
  for (int k = 0; k < count; ++k)
    out.values.push_back(k + 1 == count ? given[1] : given[0] + (given[1] - given[0]) * k / (count - 1));
  return out;
}

/// Reads a width, which must be positive.
Variation widthOf(const TomlSection& table, const char* key, Variation::Kind kind) {
  Variation out;
  out.kind = kind;
  table.require(key, out.a);
  if (!(out.a > 0)) table.fail(key, fmt::format("{}, expected a number > 0", out.a));
  return out;
}

Variation uniformOf(const TomlSection& table) {
  const std::vector<double> ends = pair(table, "uniform", "[from, to]");
  if (!(ends[0] < ends[1])) table.fail("uniform", fmt::format("[{}, {}], expected from < to", ends[0], ends[1]));
  return {Variation::Kind::uniform, ends[0], ends[1], {}};
}

Variation normalOf(const TomlSection& table) {
  const std::vector<double> given = pair(table, "normal", "[mean, standard deviation]");
  if (!(given[1] > 0)) table.fail("normal", fmt::format("standard deviation {}, expected a number > 0", given[1]));
  return {Variation::Kind::normal, given[0], given[1], {}};
}

Variation variationOf(const TomlSection& table) {
  const char* const ways[] = {"values", "steps", "uniform", "normal", "relative", "plus_minus"};
  const auto given = std::count_if(std::begin(ways), std::end(ways), [&](const char* way) { return table.has(way); });
  if (given != 1)
    table.fail(
        fmt::format("{} ways to vary, expected one of 'values', 'steps', 'uniform', 'normal', 'relative', 'plus_minus'",
                    given == 0 ? "no" : "several"));
  if (table.has("values")) return {Variation::Kind::values, 0, 0, numbers(table, "values")};
  if (table.has("steps")) return stepsOf(table);
  if (table.has("uniform")) return uniformOf(table);
  if (table.has("normal")) return normalOf(table);
  if (table.has("relative")) return widthOf(table, "relative", Variation::Kind::relative);
  return widthOf(table, "plus_minus", Variation::Kind::plus_minus);
}

Vary varyOf(const TomlSection& table, SweepDesign design) {
  table.allowOnly(sweepTables()[1]);
  Vary out;
  table.require("key", out.key);
  out.place = placeAt(table.file(), table.table().get("key")->source().begin);
  out.by = variationOf(table);
  if (design == SweepDesign::grid && out.by.kind != Variation::Kind::values)
    table.fail("in a grid, expected 'values' or 'steps'");
  return out;
}

/// Reads an integer of 64 bits, because TomlSection reads 32 bits only.
std::int64_t integerOf(const TomlSection& table, const char* key) {
  const ScenarioKey& about = keysOfDocument().key(key);
  const toml::node* node = table.table().get(key);
  if (!node->is_integer()) table.fail(key, fmt::format("expected {}", about.bound.words));
  const std::int64_t value = node->as_integer()->get();
  if (!about.bound.holds(static_cast<double>(value)))
    table.fail(key, fmt::format("{}, expected {}", value, about.bound.words));
  return value;
}

void readDesign(const TomlSection& document, SweepFile& sweep) {
  const auto design = document.readChoice(keysOfDocument().key("design"));
  if (!design) document.missing("design", "'grid', 'random' or 'sobol'");
  sweep.design = static_cast<SweepDesign>(*design);
  const bool counts = sweep.design != SweepDesign::grid;
  for (const char* key : {"count", "seed"})
    if (!counts && document.has(key))
      document.fail(key, "a grid has none, expected it with design 'random' or 'sobol'");
  if (!counts) return;
  if (!document.has("count")) document.missing("count", keysOfDocument().key("count").bound.words);
  sweep.count = integerOf(document, "count");
  if (document.has("seed")) sweep.seed = static_cast<std::uint64_t>(integerOf(document, "seed"));
}

bool readFlag(const TomlSection& table, const char* key) {
  const toml::node* node = table.table().get(key);
  if (node == nullptr) return false;
  if (!node->is_boolean()) table.fail(key, "expected true or false");
  return node->as_boolean()->get();
}

/// Reads one word, because the value becomes part of a script's line.
void readWord(const TomlSection& table, const char* key, std::string& value) {
  table.read(key, value);
  const bool plain = std::none_of(value.begin(), value.end(), [](unsigned char c) { return c <= ' ' || c == 0x7f; });
  if (!plain) table.fail(key, "expected a word without blanks");
}

SlurmSettings slurmOf(const TomlSection& table) {
  table.allowOnly(sweepTables()[2]);
  SlurmSettings out;
  readWord(table, "partition", out.partition);
  readWord(table, "time", out.time);
  readWord(table, "memory", out.memory);
  out.options = table.readStrings("options").value_or(std::vector<std::string>{});
  for (const std::string& option : out.options)
    if (option.rfind("-", 0) != 0 || option.find_first_of("\n\r") != std::string::npos)
      table.fail("options",
                 fmt::format("'{}', expected an option of sbatch in one line, such as '--account=x'", shown(option)));
  return out;
}

SweepFile assemble(const TomlSection& document, const std::filesystem::path& file) {
  for (const char* machine : {"manipulator", "mechanism"})
    if (document.has(machine) && !document.has("scenario"))
      document.fail(machine, fmt::format("a scenario, expected a sweep, which names one: scenario = \"{}\"",
                                         file.filename().string()));
  document.allowOnly(keysOfDocument());
  SweepFile sweep;
  sweep.file = file;
  std::string scenario;
  document.require("scenario", scenario);
  try {
    requirePath(scenario);
  } catch (const TextRefusal& refusal) {
    document.fail("scenario", refusal.what());
  }
  sweep.scenario = file.parent_path() / scenario;
  if (const auto work = document.readChoice(keysOfDocument().key("what"))) sweep.work = static_cast<SweepWork>(*work);
  sweep.pointwise = readFlag(document, "pointwise");
  if (sweep.pointwise && sweep.work != SweepWork::validate) document.fail("pointwise", "expected what = 'validate'");
  readDesign(document, sweep);
  if (document.has("samples")) sweep.samples = static_cast<int>(integerOf(document, "samples"));
  for (const TomlSection& table : document.sections("vary")) sweep.vary.push_back(varyOf(table, sweep.design));
  if (sweep.vary.empty()) document.missing("vary", "at least one [[vary]]");
  if (const auto table = document.section("slurm")) sweep.slurm = slurmOf(*table);
  return sweep;
}

}  // namespace

const char* name(SweepWork work) { return work == SweepWork::validate ? "validate" : "inverse"; }

const char* name(SweepDesign design) {
  return design == SweepDesign::grid ? "grid" : design == SweepDesign::random ? "random" : "sobol";
}

SweepFile parseSweepFile(const std::string& text, const std::filesystem::path& file) {
  const toml::table table = parseToml(text, file.string());
  try {
    SweepFile sweep = assemble(TomlSection(table, "", file.string()), file);
    sweep.text = text;
    return sweep;
  } catch (const PlacedError& error) {
    throw error.in(text);
  }
}

SweepFile readSweepFile(const std::filesystem::path& file) {
  try {
    return parseSweepFile(readText(file, {most_toml_bytes, "a sweep in TOML"}), file);
  } catch (const TextRefusal& refusal) {
    throw errorAt(file.string(), refusal);
  }
}

namespace {

constexpr const char* required = "!";
constexpr const char* none = "";

ScenarioTable document() {
  return {
      "",
      "(the top of the file)",
      "",
      {{"scenario", KeyType::string, "", required, "the scenario to vary; a path from this file's folder"},
       {"what",
        KeyType::choice,
        "",
        "\"validate\"",
        "validate: every check of each point; inverse: the largest efforts of each point, and its nearness to singular "
        "poses",
        {},
        {"validate", "inverse"}},
       {"pointwise", KeyType::string, "", "false", "for validate: leave out the replays; also `--pointwise`"},
       {"design",
        KeyType::choice,
        "",
        required,
        "grid: every combination of `values`; random; sobol: low-discrepancy points",
        {},
        {"grid", "random", "sobol"}},
       {"count",
        KeyType::integer,
        "",
        none,
        "number of points for random and sobol, required there",
        {"an integer from 1 to 1e12", 1, 1e12}},
       {"seed", KeyType::integer, "", "1", "seed of random and sobol", {"an integer from 0 to 2^63 - 1", 0, 9.3e18}},
       {"samples",
        KeyType::integer,
        "",
        none,
        "instants of each motion, in place of the scenario's `simulation.samples`",
        {"an integer from 2 to 1000000", 2, 1e6}},
       {"vary", KeyType::tables, "", required, "the numbers that vary, at least one", {}, {}, "vary"},
       {"slurm", KeyType::table, "", none, "for `--slurm`", {}, {}, "slurm"}}};
}

ScenarioTable vary() {
  return {"vary",
          "[[vary]]",
          "A number, and one way in which it varies.",
          {{"key", KeyType::string, "", required,
            "any number of the scenario: `manipulator.platform.mass`, `leg.3.proximal.length` (legs from 1), "
            "`leg.3.base_point.0` (entries from 0), `leg.*.base_point.*` (each by itself), a key of `leg_defaults` "
            "(all legs that do not give it)"},
           {"values", KeyType::vector, "", none, "an array of numbers"},
           {"steps", KeyType::vector, "", none, "`[from, to, count]`: so many equally spaced values"},
           {"uniform", KeyType::vector, "", none, "`[from, to]`"},
           {"normal", KeyType::vector, "", none, "`[mean, standard deviation]`"},
           {"relative", KeyType::number, "", none, "standard deviation as a share of the scenario's own value"},
           {"plus_minus", KeyType::number, "", none, "uniform, at most so far from the scenario's own value"}}};
}

ScenarioTable slurm() {
  return {"slurm",
          "[slurm]",
          "Options for `sbatch`; the cluster's defaults apply to options that are not given.",
          {{"partition", KeyType::string, "", none, ""},
           {"time", KeyType::string, "", none, "limit of each task, as `01:00:00`"},
           {"memory", KeyType::string, "", none, "memory of each task, as `500M`"},
           {"options", KeyType::choices, "", none, "further options, as `[\"--account=x\"]`"}}};
}

}  // namespace

const std::vector<ScenarioTable>& sweepTables() {
  static const std::vector<ScenarioTable> tables = {document(), vary(), slurm()};
  return tables;
}

}  // namespace ursula
