#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/sweep/run.h"

namespace ursula {

/// One job array, a task for each shard that is to be made, and the merge after it. Paths are absolute.
struct SlurmJob {
  std::filesystem::path program, sweep;
  std::filesystem::path database;  ///< that all goes into
  bool pointwise = false;
  int shards = 1;
  std::vector<int> todo;  ///< shards to be made, ascending, from 1; not looked at by the merge
  int cpus = 1;           ///< of each task
  SlurmSettings settings;
};

/// As many shards as their numbers, in the worst case every other one, fit into one option of sbatch.
constexpr int most_slurm_shards = 2000;

/// Beside the database that all goes into: "tolerances.shard-2-of-4.db".
std::filesystem::path shardDatabase(const std::filesystem::path& database, const Shard& shard);

/// Scripts, logs and the numbers of the jobs, beside the database: "tolerances.slurm".
std::filesystem::path slurmFolder(const std::filesystem::path& database);

/// As `--array` takes them: "1-3,7".
std::string arrayNumbers(const std::vector<int>& ascending);

/// What sbatch is given. Both throw std::invalid_argument: for an option in `settings` that is not the user's to set,
/// and for a path that Slurm cannot write logs to.
std::string arrayScript(const SlurmJob& job);
/// Takes together whichever shards there are.
std::string mergeScript(const SlurmJob& job);

}  // namespace ursula
