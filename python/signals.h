#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "python/lock.h"

namespace ursula::python {

/// Catches exceptions of Python's signal handlers, such as that of Ctrl-C, while no bytecode runs.
class Interruption {
 public:
  /// Works with or without Python's lock, which it takes at most twenty times per second. The interpreter's end is such
  /// an interruption, too.
  bool cameInBetween() {
    if (isAtEnd()) return true;
    constexpr std::chrono::milliseconds between{50};
    const auto now = std::chrono::steady_clock::now();
    if (raised_ || now - last_ < between) return raised_.has_value();
    last_ = now;
    const Locked locked;
    if (PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }
  void rethrow() const {
    if (raised_) throw *raised_;
    if (isAtEnd()) throw std::runtime_error("Python ends");
  }

 private:
  /// False for work that functions of `atexit` begin.
  bool isAtEnd() const { return isEnding() && !began_at_end_; }

  const bool began_at_end_ = isEnding();
  std::chrono::steady_clock::time_point last_{};
  std::optional<pybind11::error_already_set> raised_;
};

/// Rows between two checks for signals: some milliseconds, and enough for the threads of a batch.
constexpr std::size_t rows_at_once = 256, batch_at_once = 16384;

/// Calls `each(first, last)` for consecutive blocks of `count` rows, with or without Python's lock. Throws exceptions
/// of signal handlers between blocks.
template <class F>
void inBlocks(std::size_t count, std::size_t at_once, F&& each) {
  Interruption interruption;
  for (std::size_t first = 0; first < count; first += at_once) {
    each(first, std::min(first + at_once, count));
    if (interruption.cameInBetween()) interruption.rethrow();
  }
}

/// Calls `each(row)` in the same way.
template <class F>
void forRows(std::size_t count, F&& each) {
  inBlocks(count, rows_at_once, [&each](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) each(k);
  });
}

}  // namespace ursula::python
