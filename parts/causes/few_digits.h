#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ursula {

/// One effort that was answered, N·m or N.
struct Answer {
  double found = 0, right = 0;
  double limit = 0;     ///< possible difference of right efforts
  double rounding = 0;  ///< the part of it that is rounding in doubles
};

/// Whether no effort is off by more than 24-bit numbers are.
bool areNearSingle(const std::vector<Answer>& answers);

/// Returns "6 significant digits", or "0.01 N m", if a format of so many digits reproduces every answer, and all
/// deviate by at most half a unit of its last digit, or by less than one towards zero.
std::optional<std::string> roundedTo(const std::vector<Answer>& answers, const std::string& unit);

}  // namespace ursula
