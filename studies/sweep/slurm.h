#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/sweep/run.h"

namespace ursula {

/// One job array with a task per missing shard, and the merge after it. Paths are absolute.
struct SlurmJob {
  std::filesystem::path program, sweep;
  std::filesystem::path database;  ///< the final database
  bool pointwise = false;
  int shards = 1;
  std::vector<int> todo;  ///< missing shards, ascending, from 1; the merge ignores them
  int cpus = 1;           ///< per task
  SlurmSettings settings;
};

/// The largest number of shards. Even if every other one is missing, their numbers fit into one option of sbatch.
constexpr int most_slurm_shards = 2000;

/// A file next to the final database: "tolerances.shard-2-of-4.db".
std::filesystem::path shardDatabase(const std::filesystem::path& database, const Shard& shard);

/// The folder of scripts, logs and job numbers next to the database: "tolerances.slurm".
std::filesystem::path slurmFolder(const std::filesystem::path& database);

/// The format of `--array`: "1-3,7".
std::string arrayNumbers(const std::vector<int>& ascending);

/// The scripts for sbatch. Both throw std::invalid_argument for an option in `settings` that the user may not set, and
/// for a path that Slurm cannot write logs to.
std::string arrayScript(const SlurmJob& job);
/// Merges all existing shards.
std::string mergeScript(const SlurmJob& job);

}  // namespace ursula
