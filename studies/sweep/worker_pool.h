#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/sweep/design.h"
#include "studies/sweep/sweep_database.h"

namespace ursula {

/// A point as bytes between two processes of one program on one machine; the length comes first.
std::string packed(const SweepPoint& point);

/// Extracts complete points from the received bytes, in order.
class Unpacker {
 public:
  void add(std::string_view bytes) { bytes_ += bytes; }
  /// Returns false if no complete point has arrived.
  bool next(SweepPoint& point);

 private:
  std::string bytes_;
  std::size_t taken_ = 0;
};

/// Worker processes instead of threads, so that a crash harms only one of them. Its point is tried once more. Then it
/// gets the verdict "error", with how its worker ended.
///
/// Workers are copies of the calling process (fork), which should have no threads that hold locks.
class WorkerPool {
 public:
  struct Tasks {
    /// The next points to work on, none if first == end; the caller's process calls it.
    std::function<PointRange()> next;
    /// Called in a worker's process, once per worker.
    std::function<std::function<SweepPoint(std::int64_t)>()> makeWork;
    /// Returns the parameters for the row of a point without a result.
    std::function<std::string(std::int64_t)> parameters;
    /// Called for each finished point, in any order.
    std::function<void(const SweepPoint&)> done;
    /// Polled several times a second; true ends everything, and workers are stopped at once.
    std::function<bool()> stop;
  };

  WorkerPool(int workers, Tasks tasks);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Runs until all points are done, or returns false if stop() ended it. Throws std::runtime_error if no process can
  /// be created, and exceptions of `done`.
  bool run();

 private:
  struct Worker;
  void start(Worker& worker);
  void end(Worker& worker);
  bool feed(Worker& worker);
  void receive(Worker& worker);
  void crashed(Worker& worker);
  void wait();

  Tasks tasks_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::deque<PointRange> again_;     ///< of crashed workers
  std::vector<std::int64_t> tried_;  ///< points at which a worker has crashed
};

}  // namespace ursula
