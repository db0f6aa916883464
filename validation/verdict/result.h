#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/judged_subject.h"
#include "validation/verdict/failure_size.h"

namespace ursula {

/// In the order of their names in result.cpp.
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
  std::string body = {};       ///< "platform", "proximal", "distal", "legs" or "all"; of a mechanism, the file's name
  std::string parameter = {};  ///< "manipulator.leg.4.distal.mass"
  std::string unit = {};       ///< of expected, found and uncertainty
  std::optional<double> expected = {}, found = {}, uncertainty = {};
  int leg = 0, motor = 0;      ///< 1-based; 0 for none
  std::vector<int> legs = {};  ///< of order: each column's leg; else the motors or legs concerned; 1-based
  std::optional<double> from_s = {}, to_s = {};                 ///< the interval in which the efforts are wrong
  double explained = std::numeric_limits<double>::quiet_NaN();  ///< share of the deviation's square; NaN: unknown
  std::string joint = {};                                       ///< of a mechanism, by the file's name
  std::vector<int> signs = {};  ///< of order: 1, or −1 for a column with the wrong sign; empty if none has
};

/// A mistake that leaves every effort of a scenario within the limits of the verdict.
struct BlindSpot {
  std::string mistake;             ///< a sentence
  std::vector<std::string> alike;  ///< further sentences with the same cause
  NamedCause cause;
  double largest = 0;  ///< the largest change of an effort, as a share of the largest effort
};

/// The `term` of the error by which answers to a repeated question differ.
constexpr const char* repeat_term = "repeat";

/// The relative error of a solver's answers to one separate question: "statics", "angular_velocity", …
struct TermError {
  std::string term;
  double error = 0;
};

/// What the words of a cause claim.
enum class CauseClaim {
  none,      ///< no cause: they say what is known
  interval,  ///< the efforts are right but for an interval
  part,      ///< a cause of most of the deviation
  likely     ///< a cause of all of it
};

/// The wrong efforts and their cause in words.
struct CauseWords {
  std::string off, cause;
  CauseClaim claim = CauseClaim::likely;
};

/// Equally spaced instants that a file of efforts needs so that its replay can be judged.
struct NeededRows {
  std::size_t rows = 0, given = 0;
};

struct MechanismPicture;
struct Scenario;
struct JudgedValue;
struct WorstShare;

/// A check that lacks what it needs is `not_applicable`; it neither passes nor fails. Tables of its words have its
/// order.
enum class Verdict { pass, fail, inconclusive, not_applicable };

/// "pass", "fail", "inconclusive" or "not_applicable".
const char* name(Verdict verdict);

/// Why a check is not judged, or why it failed without a value.
enum class Reason {
  none,            ///< judged by value and limit
  limit_useless,   ///< the limit is too large to be useful; only this reason yields to a user's limit
  unfinished,      ///< stopped before all was judged
  not_covered,     ///< something needed is missing: samples, digits, a part of the motion, motion at all
  not_made,        ///< it could not be made at all, which is a failure
  not_applicable,  ///< it needs what scenario, subject or build lack
  reported,        ///< shown but not judged: a user's tolerance judges only the efforts
};

/// "none", "limit_useless", …
const char* name(Reason reason);

/// The largest value of a check, regardless of its limit.
struct Largest {
  double value = 0;
  double t = 0;       ///< s
  std::string where;  ///< leg or body, for people; else empty
};

/// Whose limit decided.
enum class LimitBy { derived, user };

/// "derived" or "user".
const char* name(LimitBy limit_by);

/// One judged statement. It passes only if value and limit are finite and `value <= limit`, so NaN never passes. Both
/// are of one instant, which WorstShare::shown chooses. A user's limit applies to `largest`.
struct Check {
  std::string name;  ///< `group.what`, e.g. "torque.pointwise"
  double value = 0;
  double limit = 0;
  std::string unit;
  Verdict verdict = Verdict::fail;
  std::string basis;  ///< origin of the limit, in words and numbers
  std::string why;    ///< details: which leg or body, when, how much
  Reason reason = Reason::none;
  Largest largest;
  LimitBy limit_by = LimitBy::derived;
  /// The largest error that would have passed, relative to the quantity's own size; NaN if unknown.
  double missed = std::numeric_limits<double>::quiet_NaN();
  /// A shorter error may lie between the judged instants, s; NaN if unknown.
  double gap = std::numeric_limits<double>::quiet_NaN();
  std::string off = {};  ///< the wrong efforts that make it fail, and their cause, in words; else empty
};

/// Returns nullptr if there is no check of that name.
const Check* findCheck(const std::vector<Check>& checks, const std::string& name);
/// Whether the check of that name failed.
bool fails(const std::vector<Check>& checks, const std::string& name);
bool anyIs(const std::vector<Check>& checks, Verdict verdict);
/// Whether the check belongs to a group, such as "torque".
bool isOf(const Check& check, const std::string& group);

/// Returns `why`, followed by the wrong efforts and their cause.
std::string whyInFull(const Check& check);

/// Accepts exactly if `value <= limit` and both are finite.
Check judged(std::string name, double value, double limit, std::string unit, std::string basis, std::string why);

/// Returns a check that could not be made, which is a failure.
Check notMade(std::string name, std::string unit, std::string why);

/// Returns a check that needs something missing, with the reason.
Check notApplicable(std::string name, std::string unit, std::string why);

/// Returns a check that cannot be judged here: inconclusive, with the reason.
Check notJudgeable(Reason reason, std::string name, double value, double limit, std::string unit, std::string basis,
                   std::string why);

/// Values above this share of a quantity's own size matter.
constexpr double useful_share = 1e-6;

/// Properties of a quantity with collected values.
struct CheckedQuantity {
  std::string name;  ///< name of the check
  std::string unit;
  double size = 0;   ///< size of the quantity itself along the motion, in the unit of the values
  double given = 0;  ///< possible error of its values from missing digits
  /// Largest sizes of what it is about where values were compared, and along the whole motion.
  double seen = 1, along = 1;
  bool of_motion = false;  ///< a held pose has nothing of it, and then the check does not apply
  double useful() const { return useful_share * size + given; }
};

/// Judges by WorstShare::shown. A value above the useful threshold and within its derived limit is inconclusive, with
/// `cause`. It notes if a limit exceeds the useful threshold. Nothing is held if no more was seen than useful_share of
/// what is along the motion, where even a total error would not matter: the check is then not covered.
Check judgedIfUseful(const CheckedQuantity& quantity, const WorstShare& worst, std::string basis, std::string why,
                     const std::string& cause);

/// Whether the check compares with that engine; no check does with "".
bool isOfEngine(const Check& check, const std::string& engine);

/// Returns fail if any failed or none was judged, else inconclusive if any was, else pass.
Verdict overall(const std::vector<Check>& checks);

/// Columns of equal length, named as in the CSV contract (`quantity_index_unit`).
struct TimeSeries {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  void add(std::string column_name, std::vector<double> values);
  /// Returns nullptr if there is none.
  const std::vector<double>* find(const std::string& column_name) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// One line of a curve.
struct CurveLine {
  /// What was observed, apart from its parts, or a limit.
  enum class Role { value, observed, limit };

  std::string label;
  std::string unit;  ///< empty for none
  std::vector<double> values;
  Role role = Role::value;
};

/// A chart of the report that is no part of the time series.
struct Curve {
  /// Sources of the replay's error, the replay's error against its limit, or how the numbers came about.
  enum class About { sources, limit, numerics };

  About about = About::numerics;
  std::string title;
  std::string x_label;
  bool over_time = false;  ///< x is t in s
  std::vector<double> x;
  std::vector<CurveLine> lines = {};
};

/// An event at one instant, to be marked in plots over time.
struct Event {
  double t = 0;  ///< s
  std::string what;
};

/// The formulations of one engine have one voice, so both topologies of Simbody do.
struct Voice {
  std::string engine;                     ///< as in CheckRow::engine; empty for the efforts under test
  std::vector<std::string> formulations;  ///< those that contradict other voices: "Simbody, free platform"
};

/// Which formulation of the efforts contradicts the others, at the samples.
struct OddOne {
  int formulations = 0;         ///< number of those compared
  bool agree = false;           ///< all of them
  std::vector<Voice> odd = {};  ///< explains each contradiction alone; of two, either does; of none, several are wrong

  /// The engine that contradicts the efforts under test and all others; empty if it is none, or not one alone.
  std::string engine() const { return odd.size() == 1 ? odd.front().engine : ""; }
};

/// "none: 5 formulations agree", "Simbody, both topologies", …
std::string inWords(const OddOne& odd_one);

/// The largest deviation of the subject's efforts from the expected ones.
struct EffortDeviation {
  std::string unit = "N m";   ///< unit of the efforts, as in checks; "N" if all motors slide
  double largest = 0;         ///< in that unit
  double t = 0;               ///< s
  std::string where;          ///< "leg 3"
  double largest_effort = 0;  ///< largest expected effort along the motion
  double drift = 0;           ///< bound of the platform's open-loop drift from such errors, m; NaN: unknown
  double duration = 0;        ///< duration of the motion, s
  double length = 0;          ///< length of the machine, m; with a larger drift the motion is lost
  double seen = std::numeric_limits<double>::quiet_NaN();  ///< an error of this share would have failed; NaN: unknown
  double seen_for = 0;                                     ///< if it lasts longer than this, s
  double allowed = 0;                                      ///< by a user's tolerance; 0 if there is none
  std::string without;      ///< the odd engine, from which efforts are not expected; else empty
  double from_without = 0;  ///< largest deviation from it

  double relative() const { return largest / largest_effort; }
  /// The smallest `--rtol` that would pass by itself.
  double smallestRelative() const;
};

/// The contribution of one source to the replay's position error, m.
struct SourceOfError {
  double error = 0, uncertainty = 0;
};

/// The last is what no measured source explains if the efforts are those of a file.
enum class ErrorSource { model, integration, rounding, closure, amplification, unexplained, between_samples };
/// "model", "integration", …, "between the samples".
const char* name(ErrorSource source);

/// The sources of the judged replay's error.
struct ReplayError {
  ErrorSource dominant = ErrorSource::unexplained;
  bool measured = false;       ///< false without a replay to analyse: the rest is then empty
  double t = 0, observed = 0;  ///< instant and size of the largest end error, s and m
  SourceOfError rounding, integration, closure, model;
  double unexplained = 0, uncertainty = 0;  ///< uncertainty of the sum of the sources, m
  double amplification = 0;                 ///< growth of a deviation at the window's start
};

/// A fact beside the checks that is not judged. Members that do not apply are empty, NaN or 0.
struct Finding {
  std::string name;   ///< "largest condition number of B"
  std::string words;  ///< a fact that is no number
  double value = std::numeric_limits<double>::quiet_NaN();
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
  std::string unit = {};
  double t = std::numeric_limits<double>::quiet_NaN();  ///< s
  int leg = 0;                                          ///< 1-based
};

/// Returns the fact in words: "4e-11 m +- 4e-12 m", "0.57, leg 2 at t = 0 s".
std::string textOf(const Finding& finding);

struct ValidationResult;
/// Whether a check failed, and all that did compare with the odd engine. Then the efforts are not to blame.
bool onlyOddEngineFails(const ValidationResult& result);

/// The result of one scenario's validation. Provenance keeps its order: (key, value as text).
struct ValidationResult {
  std::string scenario;
  std::string kind = "manipulator";  ///< of the machine: or "mechanism"
  JudgedSubject subject;
  LimitBy limits = LimitBy::derived;  ///< user if a user's limit, wider than the derived one, decided a check
  Verdict verdict = Verdict::fail;
  std::vector<Check> checks;
  std::vector<std::pair<std::string, std::string>> provenance;
  std::string run;  ///< names the run once its files are made
  /// Facts that are not judged: step counts, condition numbers, the dominant error, …
  std::vector<Finding> findings;
  OddOne odd_one;
  std::optional<ReplayError> replay_error;      ///< nullopt if the caller left it out
  std::optional<NamedCause> cause;              ///< of wrong efforts; nullopt unless exactly one explains everything
  std::vector<NamedCause> causes;               ///< others that explain the deviation equally well
  std::vector<NamedCause> causes_together;      ///< two or three that explain it only together; `cause` is the first
  std::optional<FailureSize> size;              ///< of wrong efforts; nullopt if none is, or the subject is the NOC
  std::optional<NeededRows> needed;             ///< nullopt unless more rows of the same digits would do
  std::vector<TermError> terms;                 ///< of a solver that was asked apart; empty for efforts from a file
  std::optional<std::vector<BlindSpot>> blind;  ///< what the scenario cannot show; nullopt if it was not asked
  CauseWords cause_words;                       ///< empty if no effort is wrong
  std::size_t replay_windows = 0;               ///< number of windows in the replay
  std::optional<EffortDeviation> deviation;     ///< nullopt if no effort was compared
  std::string effort = "torque";                ///< noun for what the motors exert, see effortNoun
  TimeSeries timeseries;
  std::vector<Curve> curves;
  std::vector<Event> events;              ///< restarts and stops of replays, poses nearest to a limit
  std::shared_ptr<const Scenario> asked;  ///< the validated scenario; null in a result that was read or constructed
  std::shared_ptr<const MechanismPicture> mechanism;  ///< the machine along its motion; null for manipulators
};

}  // namespace ursula
