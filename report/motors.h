#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// The deviation of one motor's efforts.
struct MotorDeviation {
  int motor = 0;                 ///< 0-based
  std::string unit = "Nm";       ///< unit of its efforts, as in columns
  double largest = 0, t = 0;     ///< in that unit, and its instant, s
  std::optional<double> factor;  ///< a factor that alone explains the deviation except a hundredth of its norm
  std::optional<double> offset;  ///< an offset that does so, in that unit
};

/// Returns the deviation of every motor from the columns of the subject's and Simbody's efforts. Empty if no check says
/// that efforts are wrong, or if the columns are missing.
std::vector<MotorDeviation> motorsOff(const ValidationResult& result);

}  // namespace ursula::report
