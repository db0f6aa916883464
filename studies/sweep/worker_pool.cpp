#include "studies/sweep/worker_pool.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>

#include "base/child_process.h"
#include "base/fresh_paths.h"
#include "studies/sweep/wire.h"

namespace ursula {
namespace {

constexpr int look_up = 200;      // ms between two polls of stop
constexpr std::size_t ahead = 2;  // number of ranges given to a worker, so that it never waits

/// Returns false at the end of the input.
bool readAll(int from, char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::read(from, bytes, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

/// A worker's loop until its caller closes the pipe.
void serve(int from, int to, const std::function<std::function<SweepPoint(std::int64_t)>()>& make) {
  const std::function<SweepPoint(std::int64_t)> work = make();
  PointRange range;
  while (readAll(from, reinterpret_cast<char*>(&range), sizeof range))
    for (std::int64_t i = range.first; i < range.end; ++i) {
      const std::string bytes = packed(work(i));
      if (!writeAll(to, bytes)) return;  // the caller is gone
    }
}

}  // namespace

struct WorkerPool::Worker {
  std::unique_ptr<ChildProcess> process;
  std::deque<PointRange> given;  ///< unfinished ranges; the first one shrinks with its finished points
  Unpacker arrived;

  bool runs() const { return process != nullptr; }
};

WorkerPool::WorkerPool(int workers, Tasks tasks) : tasks_(std::move(tasks)) {
  for (int k = 0; k < workers; ++k) workers_.push_back(std::make_unique<Worker>());
}

WorkerPool::~WorkerPool() = default;

void WorkerPool::start(Worker& worker) {
  worker.process = std::make_unique<ChildProcess>([this](int from, int to) {
    for (const auto& other : workers_)  // otherwise the others would never see the end of their input
      if (other->runs()) other->process->closePipes();
    serve(from, to, tasks_.makeWork);
  });
}

/// Waits for its normal end, because there are no more points.
void WorkerPool::end(Worker& worker) {
  worker.process->closePipes();
  worker.process->wait();
  worker = Worker{};
}

/// Returns false if there is nothing left to give.
bool WorkerPool::feed(Worker& worker) {
  while (worker.given.size() < ahead) {
    PointRange range;
    if (!again_.empty()) {
      range = again_.front();
      again_.pop_front();
    } else {
      range = tasks_.next();
    }
    if (range.first == range.end) break;
    if (!worker.runs()) start(worker);
    worker.given.push_back(range);
    // If the worker has just ended, reading from it shows that.
    [[maybe_unused]] const ssize_t sent = ::write(worker.process->to(), &range, sizeof range);
  }
  return !worker.given.empty();
}

void WorkerPool::receive(Worker& worker) {
  std::array<char, 65536> buffer{};
  const ssize_t got = ::read(worker.process->from(), buffer.data(), buffer.size());
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (got <= 0) {
    crashed(worker);
    return;
  }
  worker.arrived.add({buffer.data(), static_cast<std::size_t>(got)});
  SweepPoint point;
  while (worker.arrived.next(point)) {
    PointRange& range = worker.given.front();
    if (++range.first == range.end) worker.given.pop_front();
    tasks_.done(point);
  }
}

/// Returns its ranges to the queue; retries its current point once.
void WorkerPool::crashed(Worker& worker) {
  worker.process->closePipes();
  worker.process->wait();
  const std::string how = worker.process->howItEnded();
  std::deque<PointRange> left = std::move(worker.given);
  worker = Worker{};
  if (left.empty()) return;
  const std::int64_t at = left.front().first;
  if (std::find(tried_.begin(), tried_.end(), at) == tried_.end()) {
    tried_.push_back(at);
  } else {
    SweepPoint point;
    point.id = at;
    point.parameters = tasks_.parameters(at);
    point.verdict = "error";
    point.error = "its worker " + how + ", twice";
    tasks_.done(point);
    ++left.front().first;
  }
  for (const PointRange& range : left)
    if (range.first < range.end) again_.push_back(range);
}

void WorkerPool::wait() {
  std::vector<pollfd> polled;
  std::vector<Worker*> whose;
  for (const auto& worker : workers_)
    if (worker->runs()) {
      polled.push_back({worker->process->from(), POLLIN, 0});
      whose.push_back(worker.get());
    }
  if (::poll(polled.data(), polled.size(), look_up) <= 0) return;
  for (std::size_t k = 0; k < polled.size(); ++k)
    if (polled[k].revents != 0) receive(*whose[k]);
}

bool WorkerPool::run() {
  const auto former = std::signal(SIGPIPE, SIG_IGN);
  bool stopped = false;
  for (;;) {
    bool busy = false;
    for (const auto& worker : workers_) busy = feed(*worker) || busy;
    if (!busy || (stopped = tasks_.stop())) break;
    wait();
  }
  std::signal(SIGPIPE, former);
  for (const auto& worker : workers_) {
    if (stopped) worker->process.reset();  // killed
    if (worker->runs()) end(*worker);
  }
  return !stopped;
}

}  // namespace ursula
