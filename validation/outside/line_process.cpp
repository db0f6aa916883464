#include "validation/outside/line_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <locale>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text.h"
#include "model/manipulator.h"
#include "model/quaternions.h"

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
      received_.append(some.data(), count);
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
  if (!by_itself) return "closed its output";
  const bool is_missing = WIFEXITED(process_.status()) && WEXITSTATUS(process_.status()) == 127;  // by sh
  return process_.howItEnded() + (is_missing ? " (command not found)" : "");
}

void LineProcess::finish(double grace) {
  process_.closeInput();
  const double deadline = now() + grace;
  bool ended = false;
  while (receive(deadline, ended) && received_.size() <= longest_line) continue;
  process_.kill();
}

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// leadingNumber() reads neither too large nor too small numbers; a stream distinguishes them.
bool isBelowRange(std::string_view digits) {
  std::istringstream stream{std::string(digits)};
  stream.imbue(std::locale::classic());
  double value = 1;
  return stream >> value && stream.eof() && std::abs(value) < 1;
}

/// A number smaller than any double becomes 0.
double numberOf(std::string_view cell, int index, const char* what) {
  const std::string_view digits = trimmed(cell);
  const LeadingNumber number = leadingNumber(digits);
  if (number.length > 0 && number.length == digits.size() && std::isfinite(number.value)) return number.value;
  if (number.length == 0 && isBelowRange(digits)) return 0;
  throw SolverProcessError(fmt::format("its {} {} is '{}', expected a finite number{}", what, index,
                                       shown(digits, most_shown),
                                       cell.find_first_of("[(") != cell.npos ? ", and no brackets" : ""));
}

}  // namespace

std::string solverQuestion(const Motion<double>& motion) {
  Vector6d accelerations;
  accelerations << motion.p_ddot, motion.omega_dot;
  return simulatorQuestion(motion, accelerations);
}

std::string simulatorQuestion(const Motion<double>& state, const Vector6d& last) {
  const auto cells = [](const auto& vector) { return fmt::join(vector.begin(), vector.end(), ","); };
  const Eigen::Vector4d q = quaternions({state}).front();
  return fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", state.t, cells(state.p), cells(q),
                     cells(state.p_dot), cells(state.omega), cells(last));
}

Vector6d solverAnswer(const std::string& line) { return solverAnswer(line, motor_count); }

Eigen::VectorXd solverAnswer(const std::string& line, int count, const char* what) {
  std::vector<std::string_view> cells;
  const std::string_view text = line;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    cells.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  if (cells.size() != static_cast<std::size_t>(count))
    throw SolverProcessError(fmt::format("{} value{}, expected {}, separated by commas", cells.size(),
                                         cells.size() == 1 ? "" : "s",
                                         count == motor_count ? "six" : std::to_string(count)));
  Eigen::VectorXd out(count);
  for (int i = 0; i < count; ++i) out(i) = numberOf(cells[i], i + 1, what);
  return out;
}

}  // namespace ursula
