#include "studies/sweep/worker_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "studies/sweep/wire.h"

namespace ursula {
namespace {

constexpr int look_up = 200;      // ms, between two questions whether to stop
constexpr std::size_t ahead = 2;  // ranges that a worker has been given, so that it never waits for the next
constexpr int exit_lost_parent = 0;

void writeAll(int to, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(to, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) ::_exit(exit_lost_parent);  // whoever asked is gone
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// False at the end.
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

/// What a worker does until its caller wants no more.
[[noreturn]] void serve(int from, int to, const std::function<std::function<SweepPoint(std::int64_t)>()>& make) {
  const std::function<SweepPoint(std::int64_t)> work = make();
  PointRange range;
  while (readAll(from, reinterpret_cast<char*>(&range), sizeof range))
    for (std::int64_t i = range.first; i < range.end; ++i) {
      const std::string bytes = packed(work(i));
      writeAll(to, bytes.data(), bytes.size());
    }
  ::_exit(0);
}

std::string wordsOf(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("its worker was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  return fmt::format("its worker ended with {}", WEXITSTATUS(status));
}

std::array<int, 2> pipeEnds() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe to a worker");
  return ends;
}

}  // namespace

struct WorkerPool::Worker {
  pid_t process = -1;
  int to = -1, from = -1;
  std::deque<PointRange> given;  ///< not done yet; of the first its done points are taken off
  Unpacker arrived;

  bool runs() const { return process > 0; }
};

WorkerPool::WorkerPool(int workers, Tasks tasks) : tasks_(std::move(tasks)) {
  for (int k = 0; k < workers; ++k) workers_.push_back(std::make_unique<Worker>());
}

WorkerPool::~WorkerPool() {
  for (const auto& worker : workers_)
    if (worker->runs()) {
      ::kill(worker->process, SIGKILL);
      end(*worker);
    }
}

void WorkerPool::start(Worker& worker) {
  const std::array<int, 2> questions = pipeEnds(), answers = pipeEnds();
  const pid_t parent = ::getpid();
  worker.process = ::fork();
  if (worker.process < 0) throw std::system_error(errno, std::generic_category(), "no process for a worker");
  if (worker.process == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(exit_lost_parent);
    std::signal(SIGINT, SIG_IGN);  // of a terminal goes to all; the caller sees to it
    if (std::signal(SIGTERM, SIG_DFL) == SIG_IGN) std::signal(SIGTERM, SIG_IGN);  // as whoever started us wants it
    std::signal(SIGPIPE, SIG_IGN);
    for (const auto& other : workers_) {  // or they would never see the end of their questions
      if (other->to >= 0) ::close(other->to);
      if (other->from >= 0) ::close(other->from);
    }
    ::close(questions[1]);
    ::close(answers[0]);
    try {
      serve(questions[0], answers[1], tasks_.makeWork);
    } catch (...) {
      std::abort();
    }
  }
  ::close(questions[0]);
  ::close(answers[1]);
  worker.to = questions[1];
  worker.from = answers[0];
}

void WorkerPool::end(Worker& worker) {
  ::close(worker.to);
  ::close(worker.from);
  ::waitpid(worker.process, nullptr, 0);
  worker = Worker{};
}

/// False where there is nothing left to give.
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
    // A worker that has just ended is seen when it is read from.
    [[maybe_unused]] const ssize_t sent = ::write(worker.to, &range, sizeof range);
  }
  return !worker.given.empty();
}

void WorkerPool::receive(Worker& worker) {
  std::array<char, 65536> buffer{};
  const ssize_t got = ::read(worker.from, buffer.data(), buffer.size());
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

/// What it had been given is given out again; the point that it was at, once.
void WorkerPool::crashed(Worker& worker) {
  ::close(worker.to);
  ::close(worker.from);
  int status = 0;
  ::waitpid(worker.process, &status, 0);
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
    point.error = wordsOf(status) + ", twice";
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
      polled.push_back({worker->from, POLLIN, 0});
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
  for (const auto& worker : workers_)
    if (worker->runs()) {
      if (stopped) ::kill(worker->process, SIGKILL);
      end(*worker);
    }
  return !stopped;
}

}  // namespace ursula
