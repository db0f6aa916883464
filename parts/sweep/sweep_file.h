#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario_keys.h"

namespace ursula {

/// The variation of one number of a scenario.
struct Variation {
  enum class Kind {
    values,      ///< each of `values` in a grid; otherwise a random one of them
    uniform,     ///< between a and b
    normal,      ///< mean a, standard deviation b
    relative,    ///< the scenario's own value times 1 + a × a standard normal deviate
    plus_minus,  ///< uniform, at most a from the scenario's own value
  };
  Kind kind = Kind::values;
  double a = 0, b = 0;
  std::vector<double> values;
};

/// `[[vary]]`: a key, possibly with `*` for every leg or entry, each of which varies independently.
struct Vary {
  std::string key;
  std::string place;  ///< `file:line:column` of the key
  Variation by;
};

/// `[slurm]`: options for the cluster. Empty members keep its defaults.
struct SlurmSettings {
  std::string partition, time, memory;
  std::vector<std::string> options;  ///< further options of sbatch: "--account=x"
};

enum class SweepWork { validate, inverse };
enum class SweepDesign { grid, random, sobol };

/// Returns the word of the sweep file: "validate" …, "grid" ….
const char* name(SweepWork work);
const char* name(SweepDesign design);

/// A parsed sweep file; the files that it names have not been read.
struct SweepFile {
  std::filesystem::path file, scenario;
  std::string text;
  SweepWork work = SweepWork::validate;
  bool pointwise = false;  ///< for validate: without replays
  SweepDesign design = SweepDesign::random;
  std::int64_t count = 0;      ///< for random and sobol
  std::uint64_t seed = 1;      ///< for random and sobol
  std::optional<int> samples;  ///< number of instants of each motion, instead of the scenario's
  std::vector<Vary> vary;
  SlurmSettings slurm;
};

/// Throws ScenarioError with its place; unknown content is an error.
SweepFile readSweepFile(const std::filesystem::path& file);
/// Reads the same from a text.
SweepFile parseSweepFile(const std::string& text, const std::filesystem::path& file);

/// Returns the keys of a sweep's file. The reader uses them and docs/sweep.md describes them.
const std::vector<ScenarioTable>& sweepTables();

/// The largest number of points of a sweep.
constexpr std::int64_t most_points = 1'000'000'000'000;

}  // namespace ursula
