#include "studies/sweep/sweep_file.h"

namespace ursula {
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
  return {
      "vary",
      "[[vary]]",
      "A number, and one way in which it varies.",
      {{"key", KeyType::string, "", required,
        "any number of the scenario: `manipulator.platform.mass`, `leg.3.proximal.length` (legs from 1), "
        "`leg.3.base_point.0` (entries from 0), `leg.*.base_point.*` (each by itself), a key of `leg_defaults` (all "
        "legs that do not give it)"},
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
