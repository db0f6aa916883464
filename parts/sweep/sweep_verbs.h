#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "parts/sweep/run.h"

namespace ursula {

/// The verbs within `ursula sweep`.
void addSweepMerge(CLI::App& sweep, std::function<int()>& run);
void addSweepReport(CLI::App& sweep, std::function<int()>& run);
void addSweepShow(CLI::App& sweep, std::function<int()>& run);

/// Makes Ctrl-C and SIGTERM request a stop. Signals that the caller ignores stay ignored: `nohup`, background jobs of a
/// shell, `trap '' INT`.
void catchStops();
/// Returns the signal that requested it; 0 if none.
int stopSignal();

/// "tolerances.db", "tolerances.shard-2-of-4.db".
std::string defaultDatabase(const std::string& stem, const Shard& shard);

/// A sweep on a cluster.
struct SlurmCall {
  std::filesystem::path sweep, database;  ///< as given
  int shards = 0;                         ///< 0 if not given
  int cpus = 1;                           ///< per task
  bool dry_run = false;
};
/// Submits the missing shards and a merge after them; returns the exit code. Throws UsageError, and errors of databases
/// and of Slurm's commands.
int submitSweep(const SweepPlan& plan, SlurmCall call);

}  // namespace ursula
