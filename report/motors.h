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
  double share = 0;              ///< its share of the largest expected effort of that unit; 0 if there is none
  bool right = false;            ///< whether it is within the derived limit at every instant
  std::optional<double> factor;  ///< a factor that alone explains the deviation except a hundredth of its norm
  std::optional<double> offset;  ///< an offset that does so, in that unit
};

/// Returns the deviation of every motor from the columns of the subject's and Simbody's efforts. Empty if no check says
/// that efforts are wrong, or if the columns are missing.
std::vector<MotorDeviation> motorsOff(const ValidationResult& result);

/// A row for each motor: how far it is off, when, and what one number would mend it. Empty where motorsOff is.
std::string motorsTable(const ValidationResult& result);

}  // namespace ursula::report
