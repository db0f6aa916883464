#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "apps/output.h"
#include "base/start_threads.h"
#include "base/text.h"

namespace ursula {
namespace {

constexpr double silent_seconds = 2;
/// After this time without a line, a reader of a log wonders whether work goes on.
constexpr double worried_seconds = 10;
constexpr std::chrono::milliseconds redraw{250};

/// Whether a bar can be drawn; a dumb terminal cannot return to the start of a line.
bool canDraw() {
  const char* term = std::getenv("TERM");
  return ::isatty(::fileno(stderr)) == 1 && (term == nullptr || std::string(term) != "dumb");
}

}  // namespace

Progress::Progress(const std::string& what, Lines lines)
    : what_(withoutControls(what)), lines_(lines), on_terminal_(canDraw()), start_(Clock::now()) {
  if (!on_terminal_) return;
  std::vector<std::thread> started = startThreads(1, [this] { keepDrawing(); });
  if (!started.empty()) drawing_ = std::move(started.front());
}

Progress::~Progress() {
  if (!on_terminal_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  ending_.notify_all();
  if (drawing_.joinable()) drawing_.join();
  if (drawn_) sayText("\r\033[K");  // the results go to stdout
}

void Progress::at(double share, const std::string& note) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool next_tenth = static_cast<int>(10 * share) != static_cast<int>(10 * share_);
  const bool worth_a_line = next_tenth || (!said_ && seconds() > worried_seconds);
  share_ = share;
  note_ = note;
  at_seconds_ = seconds();
  if (on_terminal_ || lines_ != Lines::tenths || !worth_a_line || at_seconds_ < silent_seconds) return;
  say("{}: {}{}\n", what_, note_, timeText());
  said_ = true;
}

/// Draws in its own thread, because slow work reports rarely.
void Progress::keepDrawing() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_.wait_for(lock, redraw, [this] { return ended_; }))
    if (seconds() > silent_seconds) draw();
}

void Progress::draw() {
  constexpr std::size_t width = 30;
  const auto filled = static_cast<std::size_t>(std::clamp(share_, 0.0, 1.0) * width);
  sayText(fmt::format("\r\033[K{} [{}{}] {}{}", what_, std::string(filled, '#'), std::string(width - filled, '.'),
                      withoutControls(note_), timeText()));
  drawn_ = true;
}

/// Returns the time left, counted down since the last share. Without a share, or after the estimated end, it returns
/// the elapsed time.
std::string Progress::timeText() const {
  if (share_ <= 0) return fmt::format("{}{:.0f} s", note_.empty() ? "" : ", ", seconds());
  const double left = at_seconds_ / share_ * (1 - share_) - (seconds() - at_seconds_);
  if (share_ >= 1) return "";
  return left > 0 ? fmt::format(", about {:.0f} s left", std::max(left, 1.0)) : fmt::format(", {:.0f} s", seconds());
}

}  // namespace ursula
