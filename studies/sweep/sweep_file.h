#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario_keys.h"

namespace ursula {

/// How one number of a scenario varies.
struct Variation {
  enum class Kind {
    values,      ///< each of `values` in a grid; else one of them, each as likely
    uniform,     ///< between a and b
    normal,      ///< mean a, standard deviation b
    relative,    ///< the scenario's own value times 1 + a standard normal deviate times a
    plus_minus,  ///< uniform, at most a from the scenario's own value
  };
  Kind kind = Kind::values;
  double a = 0, b = 0;
  std::vector<double> values;
};

/// `[[vary]]`: a key, which may hold `*` for every leg or entry, each of which then varies by itself.
struct Vary {
  std::string key;
  std::string place;  ///< `file:line:column` of the key
  Variation by;
};

/// `[slurm]`: what a cluster is told beside the sweep. Empty: its own default.
struct SlurmSettings {
  std::string partition, time, memory;
  std::vector<std::string> options;  ///< further ones of sbatch: "--account=x"
};

enum class SweepWork { validate, inverse };
enum class SweepDesign { grid, random, sobol };

/// "validate" …, "grid" …
const char* name(SweepWork work);
const char* name(SweepDesign design);

/// A sweep's file as written; what it names is not looked at yet.
struct SweepFile {
  std::filesystem::path file, scenario;
  std::string text;
  SweepWork work = SweepWork::validate;
  bool pointwise = false;  ///< of validate: without replays
  SweepDesign design = SweepDesign::random;
  std::int64_t count = 0;      ///< of random and sobol
  std::uint64_t seed = 1;      ///< of random and sobol
  std::optional<int> samples;  ///< instants of each motion, in place of the scenario's
  std::vector<Vary> vary;
  SlurmSettings slurm;
};

/// Throws ScenarioError with its place; nothing is accepted that is not understood.
SweepFile readSweepFile(const std::filesystem::path& file);
/// The same from text.
SweepFile parseSweepFile(const std::string& text, const std::filesystem::path& file);

/// Its keys, as the reader takes them and docs/sweep.md describes them.
const std::vector<ScenarioTable>& sweepTables();

/// As many points as a sweep may have.
constexpr std::int64_t most_points = 1'000'000'000'000;

}  // namespace ursula
