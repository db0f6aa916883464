#include "studies/sweep/worker_pool.h"

#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/child_process.h"
#include "base/fresh_paths.h"

namespace ursula {
namespace {

class Writer {
 public:
  template <class T>
  void plain(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    plain(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
  }
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const char* at) : at_(at) {}
  template <class T>
  void plain(T& value) {
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
  }
  void text(std::string& value) {
    std::uint32_t size = 0;
    plain(size);
    value.assign(at_, size);
    at_ += size;
  }

 private:
  const char* at_;
};

/// Lists the fields of a point, for packing and unpacking.
template <class Stream, class Point>
void fields(Stream& stream, Point& point) {
  stream.plain(point.id);
  stream.plain(point.seconds);
  stream.text(point.parameters);
  stream.text(point.verdict);
  stream.text(point.error);
}

template <class Stream, class Value>
void valueFields(Stream& stream, Value& value) {
  stream.text(value.name);
  stream.plain(value.value);
  stream.plain(value.limit);
  stream.text(value.verdict);
}

}  // namespace

std::string packed(const SweepPoint& point) {
  Writer out;
  out.plain(std::uint32_t{0});
  fields(out, point);
  out.plain(static_cast<std::uint32_t>(point.values.size()));
  for (const SweepValue& value : point.values) valueFields(out, value);
  const auto size = static_cast<std::uint32_t>(out.bytes_.size() - sizeof(std::uint32_t));
  std::memcpy(out.bytes_.data(), &size, sizeof size);
  return std::move(out.bytes_);
}

bool Unpacker::next(SweepPoint& point) {
  std::uint32_t size = 0;
  const std::size_t there = bytes_.size() - taken_;
  if (there >= sizeof size) std::memcpy(&size, bytes_.data() + taken_, sizeof size);
  if (there < sizeof size || there - sizeof size < size) {
    bytes_.erase(0, std::exchange(taken_, 0));
    return false;
  }
  Reader in(bytes_.data() + taken_ + sizeof size);
  fields(in, point);
  std::uint32_t count = 0;
  in.plain(count);
  point.values.resize(count);
  for (SweepValue& value : point.values) valueFields(in, value);
  taken_ += sizeof size + size;
  return true;
}

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
