#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// The curve that takes the replay's error apart.
constexpr const char* sources_curve = "Sources of the replay's error";

/// What a result found, as typed facts: words are made of them last.
struct Found {
  std::string subject, motion;  ///< "The NOC's efforts", "the helix"
  double duration = 0;          ///< s; NaN where there is no time series
  double replay = 0;            ///< m, the replay's largest error; NaN where there was none
  double replay_limit = 0;      ///< m, where it ends; NaN where that is not known
  double agreement = 0;  ///< largest deviation of an effort between formulations, over the largest effort; NaN without
  double allowed = 0;    ///< of the largest effort, by a tolerance of the user's; 0 where there is none
  int engines = 1;       ///< formulations that give efforts, that of the subject included
  int windows = 1;       ///< that the replay was made in
  std::string dominant;  ///< source of the replay's error; may be empty
  std::string off, cause;  ///< of efforts that are wrong: which, and why; may be empty
};
Found found(const ValidationResult& result);

/// The verdict as a sentence of what was found. A failure leads with its likely cause.
std::string sentence(const ValidationResult& result);

/// What stands below it: of a failure or of what cannot be judged, the reason in detail; else empty.
std::string detail(const ValidationResult& result);

/// The few numbers that say how right it is: (what, number, remark).
struct KeyFigure {
  std::string what, value, remark;
};
std::vector<KeyFigure> keyFigures(const ValidationResult& result);

/// The text of a finding or of the provenance; "" where there is none.
std::string fact(const std::vector<std::pair<std::string, std::string>>& facts, const std::string& key);

/// What a check found, up to the words on the likely cause, which are said elsewhere.
std::string withoutCause(const std::string& cause, const std::string& why);

}  // namespace ursula::report
