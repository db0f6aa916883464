#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "studies/sweep/design.h"
#include "studies/sweep/sweep_database.h"

namespace ursula {

/// Processes that work on points, where threads do elsewhere: one that crashes takes nothing with it. The point that it
/// was at is tried once more, then it is a point with verdict "error" that says how its worker ended.
///
/// Made of copies of the calling process (fork): it should have no threads that hold locks.
class WorkerPool {
 public:
  struct Tasks {
    /// The next points to work on, none where first == end; asked by the caller's process.
    std::function<PointRange()> next;
    /// In a worker's process; made once for each worker.
    std::function<std::function<SweepPoint(std::int64_t)>()> makeWork;
    /// A point that has no result, for its row: its parameters.
    std::function<std::string(std::int64_t)> parameters;
    /// With each point that is done, in no order.
    std::function<void(const SweepPoint&)> done;
    /// Asked now and then, at least a few times a second; true ends it all. Workers are then stopped at once.
    std::function<bool()> stop;
  };

  WorkerPool(int workers, Tasks tasks);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Until all points are done, or stop() says so: false then. Throws std::runtime_error where no process can be made,
  /// and what `done` throws.
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
  std::deque<PointRange> again_;     ///< of workers that crashed
  std::vector<std::int64_t> tried_;  ///< points at which one has crashed
};

}  // namespace ursula
