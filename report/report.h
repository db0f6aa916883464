#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

class OutputFolder;

/// When something was run, for the JUnit files alone: nothing else that is written differs from run to run.
struct RunTime {
  double seconds = 0;   ///< wall time
  std::string started;  ///< UTC, as in 2026-11-22T05:13:18; empty where nobody measured, then no time is written
};

/// Runs from its making on.
class Stopwatch {
 public:
  Stopwatch();
  RunTime time() const;

 private:
  std::chrono::steady_clock::time_point start_;
  std::string started_;
};

/// One line of a suite: what the index needs to know of a scenario, without its time series.
struct SuiteEntry {
  std::string scenario;
  Verdict verdict = Verdict::fail;
  std::filesystem::path folder;  ///< of its results, relative to the index
  std::vector<Check> checks;
  std::string error;          ///< why there is no result: input that was refused, an exception; else empty
  RunTime time;               ///< of computing: the one thing of a suite that two runs write differently
  std::string dominant;       ///< which error dominates: the finding "dominant error"; may be empty
  std::vector<double> trend;  ///< the replay's error along the motion, m, in few steps; empty where none was made
  std::vector<std::pair<std::string, std::string>> properties = {};  ///< for the JUnit file: limits, provenance
};

/// The line of `result` in a suite.
SuiteEntry suiteEntry(const ValidationResult& result, std::filesystem::path folder, const RunTime& time = {});

/// The verdict's reason in one sentence: how many checks failed and the worst, or how close the closest came.
std::string reason(Verdict verdict, const std::vector<Check>& checks);

/// All that failed is of the fast kernels: the NOC itself holds.
bool onlyFastFails(const std::vector<Check>& checks);

/// "Right to 0.03 %: the largest deviation is 7.4 N m of 25066 N m, leg 3 at t = 2.97 s; …": what errors of that size
/// do, and the smallest --rtol that would pass.
std::string sentence(const EffortDeviation& deviation);

/// value / limit, 0 for values below zero; NaN without a value or without a finite limit that is not negative.
double limitShare(const Check& check);

/// The same in words: "is at 0.8 of its limit", "has no value", …
std::string standing(const Check& check);

/// How many of them apply.
std::ptrdiff_t judgedCount(const std::vector<Check>& checks);

/// The check that decides: first by verdict (fail, inconclusive, pass, not applicable), then by limitShare, where NaN
/// counts as 1; the first of equals. nullptr where there is no check.
const Check* worstCheck(const std::vector<Check>& checks);

/// Whether a result stands alone or is one of a suite, whose index is in the folder above.
enum class Place { alone, in_suite };

/// Writes `timeseries.csv`, `junit.xml`, `report.html` and, last, `summary.json` into `dir`, which has the older run's
/// until it has all of these: see OutputFolder, whose errors it throws. All but the first name the run: see stamped.
void writeResults(const ValidationResult& result, const std::filesystem::path& dir, const RunTime& time = {},
                  Place place = Place::alone);

/// The same into a folder that is committed by the caller, in its folder `below`; `result` is stamped. The line of what
/// was written.
SuiteEntry addResults(ValidationResult& result, OutputFolder& out, const std::filesystem::path& below,
                      const RunTime& time, Place place);

/// Throws std::runtime_error where results could not be written into a folder's folder `below`; writes nothing.
void requireResults(const OutputFolder& out, const std::filesystem::path& below);

/// Adds `junit.xml`, `suite.json` and `index.html` over all entries to a folder that is committed by the caller.
void addSuiteIndex(const std::vector<SuiteEntry>& entries, OutputFolder& out);

}  // namespace ursula
