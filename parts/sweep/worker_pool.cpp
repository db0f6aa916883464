#include "parts/sweep/worker_pool.h"

#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/child_process.h"
#include "base/fresh_paths.h"

namespace ursula {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SweepValue, name, value, limit, verdict)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SweepPoint, id, parameters, verdict, seconds, error, values)

std::string packed(const SweepPoint& point) {
  std::string out(sizeof(std::uint32_t), '\0');
  nlohmann::json::to_cbor(point, out);
  const auto size = static_cast<std::uint32_t>(out.size() - sizeof(std::uint32_t));
  std::memcpy(out.data(), &size, sizeof size);
  return out;
}

std::vector<SweepPoint> takePoints(std::string& bytes) {
  std::vector<SweepPoint> out;
  const char* at = bytes.data();
  const char* const end = at + bytes.size();
  for (std::uint32_t size = 0; static_cast<std::size_t>(end - at) >= sizeof size; at += size) {
    std::memcpy(&size, at, sizeof size);
    if (static_cast<std::size_t>(end - at) - sizeof size < size) break;
    at += sizeof size;
    out.push_back(nlohmann::json::from_cbor(at, at + size).get<SweepPoint>());
  }
  bytes.erase(0, at - bytes.data());
  return out;
}

namespace {

constexpr int look_up = 200;      // ms between two polls of stop
constexpr std::size_t ahead = 2;  // number of ranges given to a worker, so that it never waits

/// Returns false at the end of the input.
bool readRange(int from, PointRange& range) {
  for (std::size_t there = 0; there < sizeof range;) {
    const ssize_t got = ::read(from, reinterpret_cast<char*>(&range) + there, sizeof range - there);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    there += static_cast<std::size_t>(got);
  }
  return true;
}

/// Runs a worker's loop until its caller closes the pipe.
void serve(int from, int to, const PointWork& work) {
  PointRange range;
  while (readRange(from, range))
    for (std::int64_t i = range.first; i < range.end; ++i)
      if (!writeAll(to, packed(work(i)))) return;  // the caller is gone
}

struct Worker {
  std::unique_ptr<ChildProcess> process;
  std::deque<PointRange> given;  ///< unfinished ranges; the first one shrinks with its finished points
  std::string arrived;           ///< bytes of incomplete points
};

/// Makes a write to a process that has ended an error instead of a signal, until destroyed.
class BrokenPipesIgnored {
 public:
  BrokenPipesIgnored() : former_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~BrokenPipesIgnored() { std::signal(SIGPIPE, former_); }
  BrokenPipesIgnored(const BrokenPipesIgnored&) = delete;
  BrokenPipesIgnored& operator=(const BrokenPipesIgnored&) = delete;

 private:
  void (*former_)(int);
};

class WorkerPool {
 public:
  WorkerPool(int workers, const WorkerTasks& tasks) : tasks_(tasks), workers_(workers) {}

  bool run() {
    const BrokenPipesIgnored ignored;
    bool stopped = false;
    for (;;) {
      bool busy = false;
      for (Worker& worker : workers_) busy = feed(worker) || busy;
      if (!busy || (stopped = tasks_.stop())) break;
      wait();
    }
    for (Worker& worker : workers_) {
      if (stopped) worker.process.reset();  // killed
      if (worker.process) end(worker);
    }
    return !stopped;
  }

 private:
  void start(Worker& worker) {
    worker.process = std::make_unique<ChildProcess>([this](int from, int to) {
      for (const Worker& other : workers_)  // otherwise the others would never see the end of their input
        if (other.process) other.process->closePipes();
      serve(from, to, tasks_.makeWork());
    });
  }

  /// Waits for its end. Returns how it ended.
  static std::string end(Worker& worker) {
    worker.process->closePipes();
    worker.process->wait();
    return std::exchange(worker, {}).process->howItEnded();
  }

  PointRange next() {
    if (again_.empty()) return tasks_.next();
    const PointRange range = again_.front();
    again_.pop_front();
    return range;
  }

  /// Returns false if there is nothing left to give.
  bool feed(Worker& worker) {
    while (worker.given.size() < ahead) {
      const PointRange range = next();
      if (range.first == range.end) break;
      if (!worker.process) start(worker);
      worker.given.push_back(range);
      // If the worker has just ended, reading from it shows that.
      [[maybe_unused]] const ssize_t sent = ::write(worker.process->to(), &range, sizeof range);
    }
    return !worker.given.empty();
  }

  void receive(Worker& worker) {
    std::array<char, 65536> buffer{};
    const ssize_t got = ::read(worker.process->from(), buffer.data(), buffer.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) return;
    if (got <= 0) {
      crashed(worker);
      return;
    }
    worker.arrived.append(buffer.data(), got);
    for (const SweepPoint& point : takePoints(worker.arrived)) {
      PointRange& range = worker.given.front();
      if (++range.first == range.end) worker.given.pop_front();
      tasks_.done(point);
    }
  }

  /// Returns its ranges to the queue; retries its current point once.
  void crashed(Worker& worker) {
    std::deque<PointRange> left = std::move(worker.given);
    const std::string how = end(worker);
    if (left.empty()) return;
    const std::int64_t at = left.front().first;
    if (std::find(tried_.begin(), tried_.end(), at) == tried_.end())
      tried_.push_back(at);
    else
      tasks_.done({left.front().first++, tasks_.parameters(at), "error", 0, "its worker " + how + ", twice", {}});
    for (const PointRange& range : left)
      if (range.first < range.end) again_.push_back(range);
  }

  void wait() {
    std::vector<pollfd> polled;
    for (const Worker& worker : workers_) polled.push_back({worker.process ? worker.process->from() : -1, POLLIN, 0});
    if (::poll(polled.data(), polled.size(), look_up) <= 0) return;
    for (std::size_t k = 0; k < polled.size(); ++k)
      if (polled[k].revents != 0) receive(workers_[k]);
  }

  const WorkerTasks& tasks_;
  std::vector<Worker> workers_;
  std::deque<PointRange> again_;     ///< of crashed workers
  std::vector<std::int64_t> tried_;  ///< points at which a worker has crashed
};

}  // namespace

bool runWorkers(int workers, const WorkerTasks& tasks) { return WorkerPool(workers, tasks).run(); }

}  // namespace ursula
