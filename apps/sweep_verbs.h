#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "studies/sweep/run.h"

namespace ursula {

/// The verbs within `ursula sweep`.
void addSweepMerge(CLI::App& sweep, std::function<int()>& run);
void addSweepReport(CLI::App& sweep, std::function<int()>& run);
void addSweepShow(CLI::App& sweep, std::function<int()>& run);

/// From now on Ctrl-C and SIGTERM ask to stop. What whoever started this program wants ignored stays ignored: `nohup`,
/// a shell's background, `trap '' INT`.
void catchStops();
/// The one that asked; 0: none.
int stopSignal();

/// "tolerances.db", "tolerances.shard-2-of-4.db".
std::string defaultDatabase(const std::string& stem, const Shard& shard);

/// A sweep for a cluster.
struct SlurmCall {
  std::filesystem::path sweep, database;  ///< as given
  int shards = 0;                         ///< 0: not given
  int cpus = 1;                           ///< of each task
  bool dry_run = false;
};
/// Submits what is missing and a merge after it; the value is the exit code. Throws UsageError, and what databases and
/// Slurm's commands have to say.
int submitSweep(const SweepPlan& plan, SlurmCall call);

}  // namespace ursula
