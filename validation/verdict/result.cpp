#include "validation/verdict/result.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "model/check_catalogue.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

const char* name(CauseKind kind) {
  static constexpr const char* names[] = {"scale",        "sign",   "order",    "units",     "offset",
                                          "delay",        "digits", "state",    "parameter", "reference_point",
                                          "missing_term", "frame",  "jacobian", "closure",   "window"};
  return names[static_cast<std::size_t>(kind)];
}

const Check* findCheck(const std::vector<Check>& checks, const std::string& name) {
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return check.name == name; });
  return found == checks.end() ? nullptr : &*found;
}

bool fails(const std::vector<Check>& checks, const std::string& name) {
  const Check* check = findCheck(checks, name);
  return check != nullptr && check->verdict == Verdict::fail;
}

bool anyIs(const std::vector<Check>& checks, Verdict verdict) {
  return std::any_of(checks.begin(), checks.end(), [verdict](const Check& check) { return check.verdict == verdict; });
}

bool isOf(const Check& check, const std::string& group) { return check.name.rfind(group + ".", 0) == 0; }

bool isOfEngine(const Check& check, const std::string& engine) {
  const CheckRow* row = checkRow(check.name);
  return row != nullptr && row->engine != nullptr && row->engine == engine;
}

bool onlyOddEngineFails(const ValidationResult& result) {
  const std::string engine = result.odd_one.engine();
  return anyIs(result.checks, Verdict::fail) &&
         std::all_of(result.checks.begin(), result.checks.end(), [&engine](const Check& check) {
           return check.verdict != Verdict::fail || isOfEngine(check, engine);
         });
}

namespace {

std::string inWords(const Voice& voice) {
  if (voice.engine.empty()) return "the torques under test";
  return voice.formulations.size() == 1 ? voice.formulations.front() : voice.engine + ", both topologies";
}

}  // namespace

std::string inWords(const OddOne& odd_one) {
  const std::vector<Voice>& odd = odd_one.odd;
  if (odd_one.formulations == 0) return "unknown: no instant was compared";
  if (odd_one.agree) return fmt::format("none: {} formulations agree", odd_one.formulations);
  if (odd.size() == 1) return inWords(odd.front());
  if (odd.size() == 2)
    return fmt::format("either {} or {}: the others agree with both", inWords(odd.front()), inWords(odd.back()));
  return "not one alone: the formulations disagree in more than one way";
}

const char* name(Verdict verdict) {
  static constexpr const char* names[] = {"pass", "fail", "inconclusive", "not_applicable"};
  return names[static_cast<std::size_t>(verdict)];
}

const char* name(Reason reason) {
  static constexpr const char* names[] = {"none",     "limit_useless",  "unfinished", "not_covered",
                                          "not_made", "not_applicable", "reported"};
  return names[static_cast<std::size_t>(reason)];
}

const char* name(ErrorSource source) {
  static constexpr const char* names[] = {"model",         "integration", "rounding",           "closure",
                                          "amplification", "unexplained", "between the samples"};
  return names[static_cast<std::size_t>(source)];
}

const char* name(LimitBy limit_by) { return limit_by == LimitBy::user ? "user" : "derived"; }

Check judged(std::string name, double value, double limit, std::string unit, std::string basis, std::string why) {
  // An infinite limit would accept anything, so it counts as missing.
  const bool accepted = value <= limit && std::isfinite(value) && std::isfinite(limit);
  return {std::move(name),  value,          limit,        std::move(unit), accepted ? Verdict::pass : Verdict::fail,
          std::move(basis), std::move(why), Reason::none, {value, 0, ""}};
}

std::string whyInFull(const Check& check) { return check.off.empty() ? check.why : check.why + ". " + check.off; }

Check notMade(std::string name, std::string unit, std::string why) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {std::move(name),  none,         none, std::move(unit), Verdict::fail, "", std::move(why),
          Reason::not_made, {none, 0, ""}};
}

Check notApplicable(std::string name, std::string unit, std::string why) {
  Check out = notMade(std::move(name), std::move(unit), std::move(why));
  out.verdict = Verdict::not_applicable;
  out.reason = Reason::not_applicable;
  return out;
}

Check notJudgeable(Reason reason, std::string name, double value, double limit, std::string unit, std::string basis,
                   std::string why) {
  return {std::move(name),  value,          limit,  std::move(unit), Verdict::inconclusive,
          std::move(basis), std::move(why), reason, {value, 0, ""}};
}

namespace {

/// A check that compared nothing with nothing. It does not apply if the motion has nothing of the quantity.
Check notCovered(const CheckedQuantity& quantity, const JudgedValue& shown, std::string basis) {
  const std::string nothing = quantity.of_motion ? "nothing moves" : "no effort is needed";
  const bool anywhere = quantity.along > 0;
  Check out =
      notJudgeable(Reason::not_covered, quantity.name, shown.value, shown.limit, quantity.unit, std::move(basis),
                   anywhere ? fmt::format("not covered, since {} at the judged instants; ask for more of them", nothing)
                            : "not covered, since " + nothing);
  if (!anywhere && quantity.of_motion) out.verdict = Verdict::not_applicable;
  return out;
}

/// Missing digits hide a larger error than this share of the quantity: nobody would call that a comparison.
constexpr double most_coarse = 0.1;

Check tooCoarse(const CheckedQuantity& quantity, const JudgedValue& shown, const WorstShare& worst, std::string basis,
                const std::string& why) {
  Check out =
      notJudgeable(Reason::not_covered, quantity.name, shown.value, shown.limit, quantity.unit, std::move(basis),
                   fmt::format("{}; the printed digits leave {:.2g} of the largest value open, expected more digits",
                               why, quantity.given / quantity.size));
  out.missed = quantity.given / quantity.size;
  out.largest = {worst.largest, worst.largest_t, ""};
  return out;
}

}  // namespace

Check judgedIfUseful(const CheckedQuantity& quantity, const WorstShare& worst, std::string basis, std::string why,
                     const std::string& cause) {
  const double useful = quantity.useful();
  const JudgedValue shown = worst.shown(useful);
  if (!shown.beyond && quantity.seen <= useful_share * quantity.along)
    return notCovered(quantity, shown, std::move(basis));
  if (!shown.beyond && quantity.size > 0 && quantity.given > most_coarse * quantity.size)
    return tooCoarse(quantity, shown, worst, std::move(basis), why);
  const std::string wide =
      std::isfinite(worst.widest_limit)
          ? fmt::format("the derived limit is at most {:.3g} of the quantity's size: {}",
                        quantity.size > 0 ? worst.widest_limit / quantity.size : worst.widest_limit, cause)
          : fmt::format("no limit can be derived: {}", cause);
  Check out;
  if (shown.undecided)
    out = notJudgeable(
        Reason::limit_useless, quantity.name, shown.value, shown.limit, quantity.unit, std::move(basis),
        fmt::format(
            "{}; more than {:g} of the quantity's size and within the derived limit, it is neither right nor wrong; {}",
            why, useful_share, wide));
  else
    out = judged(quantity.name, shown.value, shown.limit, quantity.unit, std::move(basis),
                 shown.beyond || worst.widest_limit <= useful ? why : fmt::format("{}; note: {}", why, wide));
  out.missed = std::min(worst.widest_limit, useful) / quantity.size;
  out.largest = {worst.largest, worst.largest_t, ""};
  return out;
}

Verdict overall(const std::vector<Check>& checks) {
  if (anyIs(checks, Verdict::fail)) return Verdict::fail;
  if (anyIs(checks, Verdict::inconclusive)) return Verdict::inconclusive;
  return anyIs(checks, Verdict::pass) ? Verdict::pass : Verdict::fail;  // fail if nothing was judged
}

double EffortDeviation::smallestRelative() const {
  const double most = larger(largest, from_without);
  double least = most / largest_effort;
  while (least * largest_effort < most) least = std::nextafter(least, std::numeric_limits<double>::infinity());
  return least;
}

void TimeSeries::add(std::string column_name, std::vector<double> values) {
  if (find(column_name) != nullptr) throw std::invalid_argument("column " + column_name + " is there already");
  if (!columns.empty() && values.size() != rows()) {
    throw std::invalid_argument("column " + column_name + " has " + std::to_string(values.size()) + " rows, expected " +
                                std::to_string(rows()));
  }
  names.push_back(std::move(column_name));
  columns.push_back(std::move(values));
}

const std::vector<double>* TimeSeries::find(const std::string& column_name) const {
  const auto found = std::find(names.begin(), names.end(), column_name);
  return found == names.end() ? nullptr : &columns[found - names.begin()];
}

std::string textOf(const Finding& finding) {
  if (std::isnan(finding.value)) return finding.words;
  const bool counts = finding.value == std::floor(finding.value) && std::abs(finding.value) < 1e9;
  const std::string unit = finding.unit.empty() ? "" : " " + finding.unit;
  std::string out = counts ? fmt::format("{:.0f}", finding.value) : fmt::format("{:.4g}", finding.value);
  out += unit;
  if (!std::isnan(finding.uncertainty)) out += fmt::format(" +- {:.2g}{}", finding.uncertainty, unit);
  if (finding.leg > 0) out += fmt::format(", leg {}", finding.leg);
  if (!std::isnan(finding.t)) out += fmt::format(" at t = {:.6g} s", finding.t);
  return out;
}

}  // namespace ursula
