#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ursula {

enum class CauseKind {
  scale,
  sign,
  order,
  units,
  offset,
  delay,
  digits,
  state,
  parameter,
  reference_point,
  missing_term,
  frame,
  jacobian,
  closure,
  window
};
/// As `summary.json` writes it: "missing_term".
const char* name(CauseKind kind);

/// One cause of wrong efforts, in the terms of `summary.json`. What does not apply is empty.
struct NamedCause {
  CauseKind kind = CauseKind::scale;
  std::string term = {};       ///< "gravity", "gyroscopic", "angular_velocity", …
  std::string body = {};       ///< "platform", "proximal", "distal", "legs" or "all"
  std::string parameter = {};  ///< "manipulator.leg.4.distal.mass"
  std::string unit = {};       ///< of the three numbers
  std::optional<double> expected = {}, found = {}, uncertainty = {};
  int leg = 0, motor = 0;                                       ///< 1-based; 0 for none
  std::vector<int> legs = {};                                   ///< which leg's efforts each column holds, 1-based
  std::optional<double> from_s = {}, to_s = {};                 ///< the interval in which the efforts are wrong
  double explained = std::numeric_limits<double>::quiet_NaN();  ///< share of the deviation's square; NaN: unknown
};

/// What is said of a question that is asked again.
constexpr const char* repeat_term = "repeat";

/// Relative error of what a solver answers where one thing at a time is asked: "statics", "angular_velocity", …
struct TermError {
  std::string term;
  double error = 0;
};

/// Of efforts that are wrong: which, and what may have made them so.
struct LikelyCause {
  std::string off, cause;                ///< in words; `cause` says what is known where none is named
  std::optional<NamedCause> named = {};  ///< none where several machines or mistakes would do, or none does
  std::vector<NamedCause> others = {};   ///< that explain the deviation as well
  std::vector<TermError> terms = {};     ///< empty where the efforts are a file's
};

}  // namespace ursula
