#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/scalar.h"
#include "tests/model/second_reading/file_as_written.h"

// Compares a scenario's numbers with those of its file, read a second time. An error of the reader would be the same in
// every formulation, so no check of a validation sees it.

namespace ursula {

/// Counts numbers that differ from the file, and keeps the first in words.
class Mismatches {
 public:
  /// Both must be equal to the last bit; NaN equals nothing.
  void number(const std::string& place, double read, double written) {
    note(read == written && std::signbit(read) == std::signbit(written), place,
         [&] { return fmt::format("{:.17g}, the file says {:.17g}", read, written); });
  }

  template <class Read, class Written>
  void numbers(const std::string& place, const Read& read, const Written& written) {
    for (Eigen::Index i = 0; i < written.size(); ++i) number(fmt::format("{}[{}]", place, i + 1), read(i), written(i));
  }

  void text(const std::string& place, const std::string& read, const std::string& written) {
    note(read == written, place, [&] { return fmt::format("'{}', the file says '{}'", read, written); });
  }

  /// For numbers that cannot be equal to the last bit: the error must be within a rounding limit; NaN never is.
  void within(const std::string& place, double error, double limit) {
    note(error <= limit, place,
         [&] { return fmt::format("off by {:.3g} from what the file says, beyond {:.3g}", error, limit); });
  }

  int compared() const { return compared_; }
  int count() const { return count_; }
  const std::string& first() const { return first_; }

 private:
  template <class Words>
  void note(bool holds, const std::string& place, const Words& words) {
    ++compared_;
    if (holds) return;
    if (count_++ == 0) first_ = place + " is " + words();
  }

  int compared_ = 0, count_ = 0;
  std::string first_;
};

/// Returns no mismatch if the reader is right. Parameters must be equal to the last bit, 50-digit poses to rounding in
/// the 50th digit.
Mismatches mismatchesOf(const Scenario& scenario);

/// The part for the motion: compares poses at the file's instants, by other formulas than the trajectory's.
void compareTrajectory(const Trajectory& trajectory, const TrajectoryAsWritten& written, Mismatches& mismatches);

}  // namespace ursula
