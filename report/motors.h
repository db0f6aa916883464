#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// What one motor's efforts are off by.
struct MotorDeviation {
  int motor = 0;                 ///< 0-based
  std::string unit = "Nm";       ///< of its efforts, as columns write it
  double largest = 0, t = 0;     ///< in that unit, and when, s
  std::optional<double> factor;  ///< that alone explains the deviation but for a hundredth of its norm
  std::optional<double> offset;  ///< likewise, in that unit
};

/// Of every motor, from the columns of efforts on trial and Simbody's; empty where none is wrong as far as checks say,
/// or there are no such columns.
std::vector<MotorDeviation> motorsOff(const ValidationResult& result);

}  // namespace ursula::report
