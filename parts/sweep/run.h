#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "parts/sweep/sweep_plan.h"
#include "parts/sweep/worker_pool.h"

namespace ursula {

/// Returns a function that computes points of a plan, for one thread at a time. No answer depends on other points. It
/// throws nothing: the point's verdict and error hold every problem.
PointWork workOn(SweepPlan& plan);

/// A part of a sweep with consecutive points, so that merged parts stay in order.
struct Shard {
  int index = 1, of = 1;  ///< from 1

  std::int64_t first(std::int64_t points) const { return bound(index - 1, points); }
  std::int64_t end(std::int64_t points) const { return bound(index, points); }

 private:
  std::int64_t bound(int k, std::int64_t points) const {
    return points / of * k + std::min<std::int64_t>(points % of, k);
  }
};

struct SweepRunOptions {
  int jobs = 1;  ///< number of processes
  Shard shard;
  bool retry_errors = false;                                              ///< recomputes points with verdict "error"
  std::function<bool()> stop;                                             ///< polled often; true ends the run
  std::function<void(std::int64_t done, std::int64_t of)> progress = {};  ///< counts points of this shard; may be empty
};

struct SweepRunResult {
  std::int64_t points = 0, done = 0, new_ones = 0;  ///< of the shard
  std::map<std::string, std::int64_t> verdicts;     ///< counts of the existing points
  bool stopped = false;
};

/// Computes the points that `database` lacks. Rows do not depend on jobs or shards, except for their seconds. Throws
/// DatabaseError and the plan's errors; committed points stay.
SweepRunResult runSweep(SweepPlan& plan, const std::filesystem::path& database, const SweepRunOptions& options);

}  // namespace ursula
