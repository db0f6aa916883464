#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/verdict/likely_cause.h"

namespace ursula {

struct Scenario;
struct Shown;
struct Worst;

/// `not_applicable` is of checks alone: it needs what is not there, and counts neither as passed nor as failed.
enum class Verdict { pass, fail, inconclusive, not_applicable };

/// "pass", "fail", "inconclusive" or "not_applicable".
const char* name(Verdict verdict);

/// Why a check is not judged, or its failure not the value's.
enum class Reason {
  none,            ///< judged by value and limit
  limit_useless,   ///< the limit is so large that it says nothing: the only one that a limit of the user's may lift
  unfinished,      ///< stopped before the end of what was to be judged
  not_covered,     ///< something that it needs is not there: samples, digits, a part of the motion
  not_made,        ///< it could not be made at all: a failure
  not_applicable,  ///< it needs what neither scenario nor subject nor build has
  reported,        ///< shown, not judged: at a tolerance of the user's only the efforts are
};

/// "none", "limit_useless", …
const char* name(Reason reason);

/// The largest value of a check, whatever the limit there.
struct Largest {
  double value = 0;
  double t = 0;       ///< s
  std::string where;  ///< leg or body, for people; empty where there is none
};

/// Whose limit decided.
enum class LimitBy { derived, user };

/// "derived" or "user".
const char* name(LimitBy limit_by);

/// One statement that was judged: accepted exactly if `value <= limit`, so that NaN never passes. Value and limit are
/// those where their share is largest; limits of the user's are held against `largest`.
struct Check {
  std::string name;  ///< `group.what`, e.g. "torque.pointwise"
  double value = 0;
  double limit = 0;
  std::string unit;
  Verdict verdict = Verdict::fail;
  std::string basis;  ///< where the limit comes from, in words and numbers
  std::string why;    ///< what was found: which leg or body, when, how much
  Reason reason = Reason::none;
  Largest largest;
  LimitBy limit_by = LimitBy::derived;
  /// The largest error that would have passed, over the quantity's own size; NaN where that is not known.
  double missed = std::numeric_limits<double>::quiet_NaN();
};

/// Accepts exactly if `value <= limit` and both are finite.
Check judged(std::string name, double value, double limit, std::string unit, std::string basis, std::string why);

/// A check that could not be made: a failure that says so.
Check notMade(std::string name, std::string unit, std::string why);

/// A check that needs what is not there, with the reason.
Check notApplicable(std::string name, std::string unit, std::string why);

/// A check that cannot be judged here: inconclusive, with the reason.
Check notJudgeable(Reason reason, std::string name, double value, double limit, std::string unit, std::string basis,
                   std::string why);

/// Above this share of a quantity's own size a value matters.
constexpr double useful_share = 1e-6;

/// What is known of a quantity whose values were collected.
struct CheckedQuantity {
  std::string name;  ///< of the check
  std::string unit;
  double size = 0;   ///< of the quantity itself, in the unit of the values
  double given = 0;  ///< what its values may be off by since digits were not given
  double useful() const { return useful_share * size + given; }
};

/// By Worst::shown: passed, failed, or, where the value is between what is useful and a derived limit that is wider,
/// inconclusive with `cause`. That a limit is wider than is useful is noted.
Check judgedIfUseful(const CheckedQuantity& quantity, const Worst& worst, std::string basis, std::string why,
                     const std::string& cause);

/// fail if any failed or there is none, else inconclusive if any was, else pass.
Verdict overall(const std::vector<Check>& checks);

/// Columns of equal length, named as in the CSV contract (`quantity_index_unit`).
struct TimeSeries {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  void add(std::string column_name, std::vector<double> values);
  /// nullptr where there is none.
  const std::vector<double>* find(const std::string& column_name) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// Something that happened at one instant, to be marked where things are drawn over time.
struct Event {
  double t = 0;  ///< s
  std::string what;
};

/// How far the efforts on trial are from the expected ones, at most.
struct EffortDeviation {
  std::string unit = "N m";   ///< of the efforts, as checks write it; "N" where all motors slide
  double largest = 0;         ///< in that unit
  double t = 0;               ///< s
  std::string where;          ///< "leg 3"
  double largest_effort = 0;  ///< of the expected ones along the motion
  double drift = 0;     ///< how far errors of that size may move the platform by the end, open loop, m; NaN: unknown
  double duration = 0;  ///< of the motion, s
  double length = 0;    ///< of the machine, m: a drift beyond says that the motion is lost
  double seen = std::numeric_limits<double>::quiet_NaN();  ///< an error of this share would have failed; NaN: unknown
  double allowed = 0;                                      ///< by a tolerance of the user's; 0 where there is none

  double relative() const { return largest / largest_effort; }
  /// The smallest `--rtol` that would pass alone.
  double smallestRelative() const;
};

/// What one source contributed to the replay's error in position, m.
struct SourceOfError {
  double error = 0, uncertainty = 0;
};

/// What moved the judged replay off the path.
struct ReplayError {
  std::string dominant;        ///< "model", "integration", "rounding", "closure", "amplification" or "unexplained"
  bool measured = false;       ///< false where there was no replay to take apart: the rest is empty
  double t = 0, observed = 0;  ///< where it ended furthest off, s and m
  SourceOfError rounding, integration, closure, model;
  double unexplained = 0, uncertainty = 0;  ///< of the sum of the sources, m
  double amplification = 0;                 ///< by which a deviation at the window's start grows
};

/// What one scenario's validation found. Provenance keeps its order: (key, value as text).
struct ValidationResult {
  std::string scenario;
  std::string formulation;            ///< that was judged: "noc", "fast", or "external" for somebody else's
  LimitBy limits = LimitBy::derived;  ///< user: a limit of the user's, wider than the derived one, decided
  Verdict verdict = Verdict::fail;
  std::vector<Check> checks;
  std::vector<std::pair<std::string, std::string>> provenance;
  /// Facts that are not judged: step counts, condition numbers, the dominant error, …
  std::vector<std::pair<std::string, std::string>> findings;
  std::optional<ReplayError> replay_error;   ///< none where the caller left it out
  std::optional<LikelyCause> likely_cause;   ///< none where none is known
  std::size_t replay_windows = 0;            ///< in which the motion was replayed
  std::optional<EffortDeviation> deviation;  ///< none where no effort was compared
  TimeSeries timeseries;
  /// Curves for the report beside the time series, each with columns of its own (work against precision, amplification,
  /// …).
  std::vector<std::pair<std::string, TimeSeries>> curves;
  std::vector<Event> events;              ///< replays that start anew or stop, the poses nearest to a limit
  std::shared_ptr<const Scenario> asked;  ///< what was validated; null in a result that was read or made up
};

}  // namespace ursula
