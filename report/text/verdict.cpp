#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/text.h"
#include "report/files/report.h"
#include "report/text/quantity.h"

namespace ursula {
namespace {

int severity(Verdict verdict) {
  switch (verdict) {
    case Verdict::fail:
      return 3;
    case Verdict::inconclusive:
      return 2;
    case Verdict::pass:
      return 1;
    case Verdict::not_applicable:
      break;
  }
  return 0;
}

// A number beyond its limit comes before a missing number, which is often only its consequence.
std::pair<int, double> badness(const Check& check) {
  const double share = limitShare(check);
  return {severity(check.verdict), std::isnan(share) ? 1.0 : share};
}

std::string plural(std::ptrdiff_t count) { return fmt::format("{} check{}", count, count == 1 ? "" : "s"); }

}  // namespace

double limitShare(const Check& check) {
  const bool meaningful = !std::isnan(check.value) && std::isfinite(check.limit) && check.limit >= 0;
  if (!meaningful) return std::numeric_limits<double>::quiet_NaN();
  return check.value <= 0 ? 0 : check.value / check.limit;
}

std::string standing(const Check& check) {
  const double share = limitShare(check);
  if (std::isnan(check.value)) return "has no value";
  if (std::isinf(check.value)) return "is infinite";
  if (std::isnan(share)) return "cannot be set against its limit";
  if (std::isinf(share)) return "exceeds its limit of 0";
  if (share > 1) return fmt::format("is at {:.{}g} times its limit", share, share < 1.01 ? 8 : 3);
  return share == 0 ? "is at 0 % of its limit" : "is at " + report::percentText(share) + " of its limit";
}

std::ptrdiff_t judgedCount(const std::vector<Check>& checks) {
  return std::count_if(checks.begin(), checks.end(),
                       [](const Check& check) { return check.verdict != Verdict::not_applicable; });
}

const Check* worstCheck(const std::vector<Check>& checks) {
  const auto worst = std::max_element(checks.begin(), checks.end(),
                                      [](const Check& a, const Check& b) { return badness(a) < badness(b); });
  return worst == checks.end() ? nullptr : &*worst;
}

bool onlyFastFails(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.verdict != Verdict::fail || isOf(check, "fast"); });
}

std::ptrdiff_t countOf(const std::vector<Check>& checks, Verdict verdict) {
  return std::count_if(checks.begin(), checks.end(),
                       [verdict](const Check& check) { return check.verdict == verdict; });
}

std::string reason(Verdict verdict, const std::vector<Check>& checks, const CheckTitle& title) {
  if (checks.empty()) return "No check was made.";
  const Check& worst = *worstCheck(checks);
  const std::string called = title ? "“" + title(worst.name) + "”" : worst.name;
  const auto total = judgedCount(checks);
  const auto count = countOf(checks, verdict);
  // A caller may set a worse verdict than its checks; then they are not the reason.
  if (worst.verdict != verdict) return fmt::format("{} as a whole, for a reason beyond its checks.", name(verdict));
  switch (verdict) {
    case Verdict::fail:
      return fmt::format("{} of {} failed{} {}, which {}.{}", count, plural(total), count == 1 ? ":" : ", the worst",
                         called, standing(worst),
                         onlyFastFails(checks) ? " The fast kernels that users call are wrong; the NOC holds." : "");
    case Verdict::inconclusive:
      return fmt::format("Nothing failed, but {} of {} cannot be judged here{} {}.", count, plural(total),
                         count == 1 ? ":" : ", among them", called);
    case Verdict::pass:
    case Verdict::not_applicable:
      break;
  }
  const auto by_user =
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.limit_by == LimitBy::user; });
  const std::string whose =
      by_user == 0 ? "" : fmt::format(", {} at the user's limits, wider than the derived ones", by_user);
  const auto uncovered = std::count_if(checks.begin(), checks.end(), [](const Check& check) {
    return check.verdict == Verdict::not_applicable && check.reason == Reason::not_covered;
  });
  const std::string rest = uncovered == 0 ? "" : fmt::format("; {} not covered, since nothing moves", uncovered);
  return fmt::format("{} of {} held{}{}; the closest to its limit, {}, {}.", count, plural(total), whose, rest, called,
                     standing(worst));
}

namespace {

/// "0.03 %"; a plain number below a millionth, because nobody reads 0.0000003 %.
std::string shareText(double share) {
  return share >= 1e-6 ? report::percentText(share) : fmt::format("{:.1e} of the largest", share);
}

/// Two digits with a plain space before the unit.
std::string plainQuantity(double value, const char* unit) {
  std::string text = report::quantity(value, unit, 2);
  if (const auto joint = text.find("\u00a0"); joint != std::string::npos) text.replace(joint, 2, " ");
  return text;
}

std::string driftText(const EffortDeviation& deviation) {
  if (!std::isfinite(deviation.drift) || deviation.largest == 0) return "";
  if (deviation.drift > deviation.length)
    return fmt::format("from errors of this size the open-loop motion may be lost within {:.3g} s", deviation.duration);
  return fmt::format("from errors of this size the open-loop motion would drift by up to {} in {:.3g} s",
                     plainQuantity(deviation.drift, "m"), deviation.duration);
}

/// Rounds up to so many digits, so that the rounded value holds, too.
std::string roundedUp(double value, int digits) {
  if (!(value > 0 && std::isfinite(value))) return fmt::format("{:g}", value);
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - (digits - 1));
  double steps = std::floor(value / digit);
  while (leadingNumber(fmt::format("{:.{}g}", steps * digit, digits)).value < value) ++steps;
  return fmt::format("{:.{}g}", steps * digit, digits);
}

/// Two numbers: smaller errors, or shorter ones between the instants, may be there.
std::string seenText(const EffortDeviation& deviation, const std::string& effort) {
  if (!std::isfinite(deviation.seen)) return "";
  if (deviation.seen >= 1) return fmt::format("an error as large as the largest {} would not have been seen", effort);
  const std::string where = deviation.seen_for > 0 ? "that lasts longer than " + plainQuantity(deviation.seen_for, "s")
                                                   : "at one of the judged instants";
  return fmt::format("an error of {} of the largest {} {} would have been seen", roundedUp(deviation.seen, 1), effort,
                     where);
}

/// Zeros pass with a tolerance of 1, so --rtol refuses it.
std::string toleranceText(const EffortDeviation& deviation) {
  const double smallest = deviation.smallestRelative();
  return smallest >= 1 ? "no --rtol would pass" : "the smallest --rtol that would pass is " + roundedUp(smallest, 5);
}

/// "spin = "free" in [manipulator.leg_defaults]", for each table of the scenario; words of one list are together.
std::string changesText(const std::vector<ScenarioChange>& changes) {
  static const std::string numbers = "mechanism.numbers.", list = "mechanism.leave_out";
  std::string out, left_out;
  const auto add = [&out](const std::string& text) { out += (out.empty() ? "" : " and ") + text; };
  for (const auto& [key, value] : changes) {
    const std::size_t dot = key.rfind('.');
    if (key == list)
      left_out += fmt::format("{}\"{}\"", left_out.empty() ? "" : ", ", value);
    else if (key.rfind(numbers, 0) == 0)
      add(fmt::format("\"{}\" = {} in [mechanism.numbers]", key.substr(numbers.size()), value));
    else
      add(fmt::format("{} = {} in [{}]", key.substr(dot + 1), value == "{}" ? value : '"' + value + '"',
                      key.substr(0, dot)));
  }
  if (!left_out.empty()) add(fmt::format("leave_out = [{}] in [mechanism]", left_out));
  return out;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// What is known of the deviation, one thought each, in lower case and without full stops.
std::vector<std::string> deviationTexts(const ValidationResult& result) {
  if (!result.deviation) return {};
  const EffortDeviation& deviation = *result.deviation;
  if (std::isnan(deviation.largest))
    return {fmt::format("The largest deviation is unknown: {} {} is not a number", result.effort[0] == 'e' ? "an" : "a",
                        result.effort)};
  if (deviation.largest_effort == 0)
    return {fmt::format("No {} is needed here; the largest that was found is {:.3g} {}", result.effort,
                        deviation.largest, deviation.unit)};
  constexpr double right = 1e-6;  // efforts with larger errors are not called right
  const std::string without =
      deviation.without.empty() ? "" : fmt::format("Against all formulations but {}'s: ", deviation.without);
  std::vector<std::string> out = {fmt::format(
      "{}{} {}: the largest deviation is {} {} of {:.6g} {}, {} at t = {:.4g} s", without,
      deviation.relative() <= right || deviation.largest == 0 ? "Right to" : "Off by at most",
      shareText(deviation.relative()), fmt::format(deviation.largest < 1000 ? "{:.3g}" : "{:.0f}", deviation.largest),
      deviation.unit, deviation.largest_effort, deviation.unit, deviation.where, deviation.t)};
  for (const std::string& more : {driftText(deviation), toleranceText(deviation), seenText(deviation, result.effort)})
    if (!more.empty()) out.push_back(more);
  return out;
}

}  // namespace

std::vector<std::string> deviationLines(const ValidationResult& result) {
  std::vector<std::string> out;
  for (const std::string& text : deviationTexts(result)) out.push_back(capitalised(text) + ".");
  return out;
}

std::string deviationSentence(const ValidationResult& result) {
  std::string out;
  for (const std::string& text : deviationTexts(result)) {
    const bool begins = out.empty() || text.rfind("an error", 0) == 0;
    out += out.empty() ? text : begins ? ". " + capitalised(text) : "; " + text;
  }
  return out.empty() ? out : out + ".";
}

std::string remedyText(const ValidationResult& result) {
  if (!result.size || result.size->remedy.empty()) return "";
  return fmt::format("With {} the {}s are right", changesText(result.size->remedy), result.effort);
}

std::string sizeText(const ValidationResult& result) {
  if (!result.size) return "";
  const FailureSize& size = *result.size;
  std::string term = size.least_term;
  std::replace(term.begin(), term.end(), '_', ' ');
  const std::string least =
      fmt::format("the least term of the equations, {}, whose effect is {}", term, shareText(size.least_share));
  switch (size.grade) {
    case FailureGrade::rounding:
      return fmt::format("rounding: {:.3g} times the limit", size.limits);
    case FailureGrade::modelling:
      if (!size.remedy.empty()) return "a modelling difference";
      return "a modelling difference: less than " + least;
    case FailureGrade::wrong:
      break;
  }
  return size.least_term.empty() ? "wrong" : "wrong: more than " + least;
}

}  // namespace ursula
