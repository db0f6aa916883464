#include "validation/outside/line_process.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

namespace ursula {
namespace {

/// An answer of six numbers has some 150 characters.
constexpr std::size_t longest_line = 1 << 16;

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Turns SIGPIPE, from a write to an ended process, into an error of the call.
class WithoutPipeSignal {
 public:
  WithoutPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutPipeSignal() {
    const timespec at_once{};
    while (!was_pending_ && sigtimedwait(&pipe_, nullptr, &at_once) == -1 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutPipeSignal(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

/// Waits until `end` is ready for `events`; false at the deadline.
bool ready(int end, short events, double deadline) {
  pollfd waited{end, events, 0};
  for (;;) {
    const double left = std::max(0.0, deadline - now());
    const int milliseconds = static_cast<int>(std::min(std::ceil(1e3 * left), 1e9));
    const int count = ::poll(&waited, 1, milliseconds);
    if (count > 0) return true;
    if (count < 0 && errno != EINTR) fail("waiting for the solver", errno);
    if (count == 0 && now() >= deadline) return false;
  }
}

}  // namespace

LineProcess::LineProcess(const std::string& command, const Environment& environment)
    : process_({{"/bin/sh", "-c", command}, environment, true}) {
  for (const int end : {process_.to(), process_.from()}) ::fcntl(end, F_SETFL, O_NONBLOCK);
}

bool LineProcess::write(const std::string& text, double deadline) {
  const WithoutPipeSignal guard;
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(process_.to(), text.data() + done, text.size() - done);
    if (count >= 0)
      done += static_cast<std::size_t>(count);
    else if (errno == EPIPE)
      return false;
    else if (errno != EAGAIN && errno != EINTR)
      fail("writing to the solver", errno);
    else if (!ready(process_.to(), POLLOUT, deadline))
      return false;
  }
  return true;
}

bool LineProcess::receive(double deadline, bool& ended) {
  std::array<char, 4096> some{};
  for (;;) {
    const ssize_t count = ::read(process_.from(), some.data(), some.size());
    if (count > 0) {
      received_.append(some.data(), static_cast<std::size_t>(count));
      return true;
    }
    ended = count == 0;
    if (ended) return false;
    if (errno != EAGAIN && errno != EINTR) fail("reading from the solver", errno);
    if (!ready(process_.from(), POLLIN, deadline)) return false;
  }
}

LineProcess::Answer LineProcess::ask(const std::string& line, double timeout) {
  const double deadline = now() + timeout;
  write(line + '\n', deadline);  // after a failure, the received output says more than the error
  bool ended = false;
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    const std::size_t before = received_.size();
    if (before > longest_line) return {received_.substr(0, longest_line), End::too_long};
    if (!receive(deadline, ended)) return {std::exchange(received_, ""), ended ? End::closed : End::late};
    end = received_.find('\n', before);
  }
  Answer out{received_.substr(0, end), End::line};
  received_.erase(0, end + 1);
  return out;
}

std::string LineProcess::unasked() {
  bool ended = false;
  if (received_.empty()) receive(0, ended);
  return received_;
}

std::string LineProcess::ending() {
  const double deadline = now() + 1;  // its output is closed, so it is about to end
  while (!process_.hasEnded() && now() < deadline) ::poll(nullptr, 0, 1);
  const bool by_itself = process_.hasEnded();
  process_.kill();
  return by_itself ? process_.howItEnded() : "closed its output";
}

void LineProcess::finish(double grace) {
  process_.closeInput();
  const double deadline = now() + grace;
  bool ended = false;
  while (receive(deadline, ended) && received_.size() <= longest_line) continue;
  process_.kill();
}

}  // namespace ursula
