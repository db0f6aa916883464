#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// The facts of a result, from which texts are made.
struct ResultFacts {
  std::string subject, motion;  ///< "The NOC's efforts", "the helix"
  double duration = 0;          ///< s; NaN without a time series
  double replay = 0;            ///< m, the replay's largest error; NaN without a replay
  double replay_limit = 0;      ///< m, at the replay's end; NaN if unknown
  double agreement =
      0;               ///< largest deviation of an effort between formulations, over the largest effort; NaN if unknown
  double allowed = 0;  ///< relative to the largest effort, by a user's tolerance; 0 if there is none
  int engines = 1;     ///< number of formulations that give efforts, including the subject's
  int windows = 1;     ///< number of windows in the replay
  std::optional<ErrorSource> dominant;  ///< of the replay's error
  CauseWords wrong;                     ///< which efforts are wrong, and why; may be empty
};
ResultFacts factsOf(const ValidationResult& result);

/// Returns the text below the sentence: the detailed reason for a failure or an undecided verdict; else empty.
std::string detail(const ValidationResult& result);

/// One of the few numbers that show how right a result is: what, number, remark.
struct KeyFigure {
  std::string what, value, remark;
};
std::vector<KeyFigure> keyFigures(const ValidationResult& result);

/// Returns the findings' names and texts.
std::vector<std::pair<std::string, std::string>> findingTexts(const ValidationResult& result);

/// Whether a failed check of the efforts only repeats `first`: as large a deviation from another formulation, or the
/// acceleration that it causes.
bool repeats(const Check& check, const Check& first);

/// Returns "likely cause: a factor of 1.001 on leg 3"; words that claim no cause stay alone.
std::string causeText(const CauseWords& words);

/// Returns the page of one check, in lines of at most 100 columns. Throws std::invalid_argument for an unknown check,
/// with the nearest known one.
std::string explanation(const std::string& check);

/// Returns every check with its meaning, in groups.
std::string explanations();

/// docs/checks.md: what every check proves and cannot see, the origin of its limit, and what to do after a failure.
std::string checksMarkdown();

}  // namespace ursula::report
