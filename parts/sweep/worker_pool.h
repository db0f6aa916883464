#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "parts/sweep/design.h"
#include "parts/sweep/sweep_database.h"

namespace ursula {

/// A point as bytes between two processes of one program on one machine; the length comes first.
std::string packed(const SweepPoint& point);

/// Takes the complete points from the beginning of the received bytes, in order.
std::vector<SweepPoint> takePoints(std::string& bytes);

/// Computes the row and the results of a point.
using PointWork = std::function<SweepPoint(std::int64_t)>;

struct WorkerTasks {
  /// The next points to work on, none if first == end; the caller's process calls it.
  std::function<PointRange()> next;
  /// Called in a worker's process, once per worker.
  std::function<PointWork()> makeWork;
  /// Returns the parameters for the row of a point without a result.
  std::function<std::string(std::int64_t)> parameters;
  /// Called for each finished point, in any order.
  std::function<void(const SweepPoint&)> done;
  /// Polled several times a second; true ends everything, and workers are stopped at once.
  std::function<bool()> stop;
};

/// Runs until all points are done, or returns false if stop() ended it. Throws std::runtime_error if no process can be
/// created, and exceptions of `done`.
///
/// Worker processes instead of threads, so that a crash harms only one of them. Its point is tried once more. Then it
/// gets the verdict "error", with how its worker ended. Workers are copies of the calling process (fork), which should
/// have no threads that hold locks.
bool runWorkers(int workers, const WorkerTasks& tasks);

}  // namespace ursula
