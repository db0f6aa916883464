#pragma once

#include <chrono>
#include <cstddef>

#include "validation/report/report.h"

namespace ursula {

/// Says on stderr how far a suite is: on a terminal a bar with the time left, elsewhere a line for each scenario.
class SuiteProgress {
 public:
  explicit SuiteProgress(std::size_t total);
  ~SuiteProgress();
  SuiteProgress(const SuiteProgress&) = delete;
  SuiteProgress& operator=(const SuiteProgress&) = delete;

  /// `entry` is done, the done-th. Not from two threads at once.
  void finished(const SuiteEntry& entry, std::size_t done);

 private:
  void drawBar(std::size_t done) const;

  std::size_t total_, not_passed_ = 0;
  bool on_terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace ursula
