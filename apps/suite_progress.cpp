#include "apps/suite_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace ursula {

SuiteProgress::SuiteProgress(std::size_t total)
    : total_(total), on_terminal_(::isatty(::fileno(stderr)) == 1), start_(std::chrono::steady_clock::now()) {
  if (on_terminal_) drawBar(0);
}

SuiteProgress::~SuiteProgress() {
  if (on_terminal_) std::fputs("\r\033[K", stderr);  // the lines on stdout say it all
}

void SuiteProgress::finished(const SuiteEntry& entry, std::size_t done) {
  if (entry.verdict != Verdict::pass) ++not_passed_;
  if (on_terminal_)
    drawBar(done);
  else
    fmt::print(stderr, "[{}/{}] {} {}, {:.1f} s\n", done, total_, name(entry.verdict), entry.scenario, entry.seconds);
}

void SuiteProgress::drawBar(std::size_t done) const {
  constexpr std::size_t width = 30;
  const std::size_t filled = width * done / total_;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = done == 0 ? 0 : elapsed / static_cast<double>(done) * static_cast<double>(total_ - done);
  fmt::print(stderr, "\r\033[K[{}{}] {} of {}{}{}", std::string(filled, '#'), std::string(width - filled, '.'), done,
             total_, not_passed_ > 0 ? fmt::format(", {} not passed", not_passed_) : "",
             done == 0 ? "" : fmt::format(", about {:.0f} s left", left));
  std::fflush(stderr);
}

}  // namespace ursula
