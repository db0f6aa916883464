#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "parts/sweep/run.h"

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

/// Returns the database of a shard, next to the final one: "tolerances.shard-2-of-4.db".
std::filesystem::path shardDatabase(const std::filesystem::path& database, const Shard& shard);

/// Returns the folder of scripts, logs and job numbers next to the database: "tolerances.slurm".
std::filesystem::path slurmFolder(const std::filesystem::path& database);

/// Returns the numbers in the format of `--array`: "1-3,7".
std::string arrayNumbers(const std::vector<int>& ascending);

/// Returns the script of the job array for sbatch. This function and mergeScript() throw std::invalid_argument for an
/// option in `settings` that the user may not set, and for a path that Slurm cannot write logs to.
std::string arrayScript(const SlurmJob& job);
/// Returns the script that merges all existing shards.
std::string mergeScript(const SlurmJob& job);

/// The jobs of a sweep, as stored next to its database.
struct SlurmJobs {
  int shards = 0;  ///< number of the sweep's shards; 0 without a job
  std::vector<std::int64_t> arrays, merges;
};

/// Reads `FOLDER/jobs.json`. Returns no jobs if it is missing. Throws std::runtime_error for other content.
SlurmJobs readSlurmJobs(const std::filesystem::path& folder);
void writeSlurmJobs(const std::filesystem::path& folder, const SlurmJobs& jobs);

/// A running or waiting job, or task of an array.
struct QueuedTask {
  std::int64_t job = 0;
  int index = 0;      ///< 0 if it belongs to no array
  std::string state;  ///< Slurm's state: "RUNNING", "PENDING"
};

/// The format that squeue is asked for. readQueue() parses its answer and throws std::runtime_error for another one.
constexpr const char* queue_format = "%F|%K|%T";
std::vector<QueuedTask> readQueue(const std::string& answer);

enum class ShardState {
  missing,   ///< does not exist, or lacks points
  queued,    ///< in Slurm's queue
  locked,    ///< another process writes to its database
  complete,  ///< in its own or in the final database
};

/// The progress of a sweep on the cluster.
struct SlurmStanding {
  std::vector<ShardState> shards;               ///< starting with shard 1
  std::vector<std::int64_t> arrays, merges;     ///< jobs still in the queue
  bool merged = false;                          ///< all points are in the final database
  std::vector<int> in(ShardState state) const;  ///< numbers of these shards, from 1
};

/// Returns the progress. `sweep` is the whole one; `queue` is empty without Slurm. It does not open databases of queued
/// shards, because a shared file system may allow only one machine at a time. Throws DatabaseError for a database of
/// another sweep, and for a damaged one.
SlurmStanding standingOf(const SweepIdentity& sweep, const std::filesystem::path& database, int shards,
                         const SlurmJobs& jobs, const std::vector<QueuedTask>& queue);

}  // namespace ursula
