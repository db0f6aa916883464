#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

class OutputFolder;

/// The time of a run, for JUnit files only. Everything else is equal in equal runs.
struct RunTime {
  double seconds = 0;   ///< wall time
  std::string started;  ///< UTC, as in 2026-11-22T05:13:18; if empty, no time is written
};

/// What was found of a scenario without judging efforts.
struct CheckedScenario {
  std::string file, name;
  std::string error = {};  ///< why its motion cannot be judged; else empty
  std::vector<std::string> warnings = {}, assumptions = {};
  std::optional<std::vector<BlindSpot>> blind = {};  ///< nullopt if the build knows no mistakes
};

/// Measures time from its construction.
class Stopwatch {
 public:
  Stopwatch();
  RunTime time() const;

 private:
  std::chrono::steady_clock::time_point start_;
  std::string started_;
};

/// A scenario's entry in a suite, without the time series.
struct SuiteEntry {
  std::string scenario;
  Verdict verdict = Verdict::fail;
  std::filesystem::path folder;  ///< folder of its results, relative to the index
  std::vector<Check> checks;
  std::string error;          ///< why there is no result: refused input, an exception; else empty
  RunTime time;               ///< computing time, the only value that differs between equal runs
  std::string dominant;       ///< the finding "dominant error"; may be empty
  std::vector<double> trend;  ///< the replay's error along the motion, m, in few steps; empty without a replay
  std::vector<std::pair<std::string, std::string>> properties = {};  ///< for the JUnit file: limits, provenance
  std::string run = {};                                              ///< as in ValidationResult
  std::string kind = "manipulator";                                  ///< of the machine, as in ValidationResult
  std::string cause = {};                                            ///< "likely cause: …"; empty if none is named
};

/// Returns the entry of `result` in a suite.
SuiteEntry suiteEntry(const ValidationResult& result, std::filesystem::path folder, const RunTime& time = {});

/// Returns the verdict's reason in one sentence: the number of failed checks and the worst, or the nearest to its
/// limit. That check has its name, by which `explain` knows it, or is called otherwise.
using CheckTitle = std::function<std::string(const std::string& name)>;
std::string reason(Verdict verdict, const std::vector<Check>& checks, const CheckTitle& title = {});

/// Whether only checks of the fast kernels failed, so that the NOC itself is right.
bool onlyFastFails(const std::vector<Check>& checks);

/// Returns "Right to 0.03 %: the largest deviation is 7.4 N m of 25066 N m, leg 3 at t = 2.97 s; …", followed by the
/// effect of such errors and the smallest --rtol that would pass; empty if no effort was compared.
std::string deviationSentence(const ValidationResult& result);
/// Returns the same as lines, one thought each.
std::vector<std::string> deviationLines(const ValidationResult& result);

/// Returns "a modelling difference", "wrong: more than the least term …"; empty if no effort is wrong.
std::string sizeText(const ValidationResult& result);
/// Returns "With spin = "free" in [manipulator.leg_defaults] the forces are right"; empty if no such change is known.
std::string remedyText(const ValidationResult& result);

/// Returns value / limit, and 0 for values below zero; NaN without a value or without a finite non-negative limit.
double limitShare(const Check& check);

/// The same in words: "is at 0.8 of its limit", "has no value", …
std::string standing(const Check& check);

std::ptrdiff_t countOf(const std::vector<Check>& checks, Verdict verdict);

/// Returns how many of the checks apply.
std::ptrdiff_t judgedCount(const std::vector<Check>& checks);

/// Returns the decisive check, the first of equals: first by verdict (fail, inconclusive, pass, not applicable), then
/// by limitShare, where NaN counts as 1. Returns nullptr if there is no check.
const Check* worstCheck(const std::vector<Check>& checks);

/// Whether a result stands alone or belongs to a suite with its index in the parent folder.
enum class Place { alone, in_suite };

/// Writes `timeseries.csv`, `junit.xml`, `report.html` and finally `summary.json` into `dir`, which keeps an older
/// run's files until all are complete. OutputFolder does this and throws its errors. All but the first identify the
/// run: see stamped.
void writeResults(const ValidationResult& result, const std::filesystem::path& dir, const RunTime& time = {},
                  Place place = Place::alone);

/// Writes the same into the folder `below` of `out`, which the caller commits; stamps `result`. Returns the entry of
/// the written results.
SuiteEntry addResults(ValidationResult& result, OutputFolder& out, const std::filesystem::path& below,
                      const RunTime& time, Place place);

/// Throws std::runtime_error if results could not be written into the folder `below` of `out`; writes nothing.
void requireResults(const OutputFolder& out, const std::filesystem::path& below);

/// Adds `junit.xml`, `suite.json` and `index.html` over all entries to a folder that the caller commits.
void addSuiteIndex(const std::vector<SuiteEntry>& entries, OutputFolder& out);

}  // namespace ursula

namespace ursula::report {

/// Returns the verdict as a sentence about the results. A failure starts with its likely cause.
std::string sentence(const ValidationResult& result);

/// Returns a result as text for a mail: verdict, size of the deviation and cause; then a line for each group of checks,
/// with those that did not pass and why; then details of wrong motors. `verbose` gives all checks with value, limit,
/// unit and share, and the reasons of those that do not apply.
std::string validationText(const ValidationResult& result, bool coloured, bool verbose = false);

}  // namespace ursula::report
