#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// Deviation of one motor's efforts.
struct MotorDeviation {
  int motor = 0;                 ///< 0-based
  std::string unit = "Nm";       ///< unit of its efforts, as in columns
  double largest = 0, t = 0;     ///< largest deviation in that unit, and its instant, s
  double share = 0;              ///< its share of the largest expected effort of that unit; 0 if there is none
  bool right = false;            ///< whether it is within the derived limit at every instant
  std::optional<double> factor;  ///< a factor that alone explains all but a hundredth of the deviation's norm
  std::optional<double> offset;  ///< an offset that does so, in that unit
};

/// Returns the deviation of every motor from the columns of the subject's and Simbody's efforts. Empty if no check says
/// that efforts are wrong, or if the columns are missing.
std::vector<MotorDeviation> motorsOff(const ValidationResult& result);

/// Returns a row for each motor: its deviation, the instant, and the one number that would correct it. Empty if
/// motorsOff is.
std::string motorsTable(const ValidationResult& result);

}  // namespace ursula::report
