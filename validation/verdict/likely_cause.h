#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ursula {

/// In the order of their names in likely_cause.cpp.
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
/// The name in `summary.json`: "missing_term".
const char* name(CauseKind kind);

/// One cause of wrong efforts, in the terms of `summary.json`. Members that do not apply are empty.
struct NamedCause {
  CauseKind kind = CauseKind::scale;
  std::string term = {};       ///< "gravity", "gyroscopic", "angular_velocity", …
  std::string body = {};       ///< "platform", "proximal", "distal", "legs" or "all"
  std::string parameter = {};  ///< "manipulator.leg.4.distal.mass"
  std::string unit = {};       ///< unit of the three numbers
  std::optional<double> expected = {}, found = {}, uncertainty = {};
  int leg = 0, motor = 0;                                       ///< 1-based; 0 for none
  std::vector<int> legs = {};                                   ///< the leg whose efforts each column contains, 1-based
  std::optional<double> from_s = {}, to_s = {};                 ///< the interval in which the efforts are wrong
  double explained = std::numeric_limits<double>::quiet_NaN();  ///< share of the deviation's square; NaN: unknown
};

/// The `term` of the error by which answers to a repeated question differ.
constexpr const char* repeat_term = "repeat";

/// The relative error of a solver's answers to one separate question: "statics", "angular_velocity", …
struct TermError {
  std::string term;
  double error = 0;
};

/// The wrong efforts and their cause in words. Without a named cause, `cause` gives what is known.
struct CauseWords {
  std::string off, cause;
};

}  // namespace ursula
