#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "studies/sweep/slurm.h"

namespace ursula {

/// The jobs that a sweep was given to, as kept beside its database.
struct SlurmJobs {
  int shards = 0;  ///< that the sweep was cut into; 0: no job yet
  std::vector<std::int64_t> arrays, merges;
};

/// `FOLDER/jobs.json`; no jobs where it is not there. Throws std::runtime_error where it is something else.
SlurmJobs readSlurmJobs(const std::filesystem::path& folder);
void writeSlurmJobs(const std::filesystem::path& folder, const SlurmJobs& jobs);

/// A job, or a task of an array, that runs or waits.
struct QueuedTask {
  std::int64_t job = 0;
  int index = 0;      ///< 0: of no array
  std::string state;  ///< Slurm's word: "RUNNING", "PENDING"
};

/// What squeue is asked for, and how its answer reads. Throws std::runtime_error for another answer.
constexpr const char* queue_format = "%F|%K|%T";
std::vector<QueuedTask> readQueue(const std::string& answer);

enum class ShardState {
  missing,   ///< nowhere, or points of it are
  queued,    ///< of Slurm's queue
  locked,    ///< somebody else writes to its database
  complete,  ///< in its own database, or in the one that all goes into
};

struct ShardStanding {
  ShardState state = ShardState::missing;
  std::int64_t done = 0;  ///< points that are there; not counted of what is queued
};

/// How far a sweep has come on the cluster.
struct SlurmStanding {
  std::vector<ShardStanding> shards;            ///< from shard 1 on
  std::vector<std::int64_t> arrays, merges;     ///< jobs that are still in the queue
  bool merged = false;                          ///< all points are in the one database
  std::vector<int> in(ShardState state) const;  ///< numbers of the shards, from 1
};

/// `sweep` is that of the whole; `queue` is empty where there is no Slurm. Databases of queued shards are left alone:
/// on a file system that is shared they may be read from one machine at a time. Throws DatabaseError for a database of
/// another sweep, and for a damaged one.
SlurmStanding standingOf(const SweepIdentity& sweep, const std::filesystem::path& database, int shards,
                         const SlurmJobs& jobs, const std::vector<QueuedTask>& queue);

}  // namespace ursula
