#include "report/text/result_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "model/check_catalogue.h"
#include "model/mechanism_picture.h"
#include "model/scenario.h"
#include "model/trajectories/trajectory_kinds.h"
#include "report/files/report.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const Check* find(const ValidationResult& result, const std::string& name) {
  const Check* check = findCheck(result.checks, name);
  return check == nullptr || check->verdict == Verdict::not_applicable ? nullptr : check;
}

double largestOf(const TimeSeries& series, const std::string& beginning) {
  double largest = 0;
  for (std::size_t k = 0; k < series.names.size(); ++k)
    if (series.names[k].rfind(beginning, 0) == 0)
      for (const double value : series.columns[k])
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Formulations of one engine, such as Simbody's two topologies, count as one.
void addEngines(const ValidationResult& result, ResultFacts& facts) {
  double worst = none;
  std::set<std::string> engines;
  for (const CheckRow& row : checkCatalogue()) {
    const bool of_efforts = std::string_view(row.name).rfind("torque.", 0) == 0 && row.needs != CheckNeeds::torque_file;
    const Check* check = row.engine != nullptr && of_efforts ? find(result, row.name) : nullptr;
    if (check == nullptr || !std::isfinite(check->largest.value)) continue;
    worst = std::isnan(worst) ? check->largest.value : std::max(worst, check->largest.value);
    engines.insert(row.engine);
  }
  facts.engines += static_cast<int>(engines.size());
  const double of_engine = largestOf(result.timeseries, "simbody_tau_");
  const double expected = of_engine > 0 ? of_engine : largestOf(result.timeseries, "tau_");
  facts.agreement = expected > 0 ? worst / expected : none;
  if (result.deviation && expected > 0) facts.allowed = result.deviation->allowed / expected;
}

/// The name of a file or a command stays as it is.
std::string ofWhom(const JudgedSubject& subject, const std::string& effort) {
  if (subject.formulation == Formulation::noc) return inEffortWords(effort, "The NOC's efforts");
  return inEffortWords(effort, "The efforts") + (subject.name.empty() ? "" : " of " + subject.name);
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// Lower case for use within a sentence.
std::string lower(std::string text) {
  if (text.rfind("The ", 0) == 0) text[0] = 't';
  return text;
}

/// The text as `unbroken` has it, but for the name of a file or a command.
std::string unbrokenBut(const std::string& name, const std::string& text) {
  const std::size_t at = name.empty() ? std::string::npos : text.find(name);
  if (at == std::string::npos) return unbroken(text);
  return unbroken(text.substr(0, at)) + name + unbroken(text.substr(at + name.size()));
}

std::string drives(const ResultFacts& facts) {
  if (std::isnan(facts.replay)) return facts.subject + " hold";
  const std::string windows = facts.windows > 1 ? fmt::format(", in {} windows", facts.windows) : "";
  return fmt::format("{} drive Simbody's loop along {} to {} in {}{}", facts.subject, facts.motion,
                     quantity(facts.replay, "m"), quantity(facts.duration, "s"), windows);
}

/// A share of the largest effort: in percent unless it is tiny.
std::string sizeOf(double share) { return share < 1e-6 ? plainNumber(share, 2) : percentText(share); }

std::string agrees(const ResultFacts& facts) {
  if (facts.engines < 2 || std::isnan(facts.agreement)) return "";
  std::string share =
      facts.agreement > 0 ? "to " + sizeOf(facts.agreement) + " of the largest effort" : "to the last digit";
  if (facts.allowed > 0) share += ", your tolerance is " + sizeOf(facts.allowed);
  return facts.engines == 2 ? "; Simbody's own inverse dynamics agree " + share
                            : fmt::format("; {} independent formulations agree {}", inWords(facts.engines), share);
}

/// Returns ". Likely cause: platform mass 303 ± 1 kg". A share that lacks only rounding becomes "all of it". Words that
/// claim no cause follow after `mark`.
std::string inPrint(const CauseWords& words, const char* mark) {
  std::string cause = words.cause;
  const std::string nearly = ", which explains more than 99.9999 % of the deviation",
                    all = ", which explains all of it";
  for (std::size_t at = cause.find(nearly); at != std::string::npos; at = cause.find(nearly, at + all.size()))
    cause.replace(at, nearly.size(), all);
  switch (words.claim) {
    case CauseClaim::none:
    case CauseClaim::interval:
      return mark + (*mark == '.' ? capital(cause) : cause);
    case CauseClaim::part:
      return ". " + capital(cause);
    case CauseClaim::likely:
      break;
  }
  return ". Likely cause: " + cause;
}

/// "are wrong", or less than that.
const char* areWrong(const ValidationResult& result) {
  if (!result.size || result.size->grade == FailureGrade::wrong) return "are wrong";
  return result.size->grade == FailureGrade::rounding ? "are off by rounding" : "differ in the model";
}

std::string failed(const ValidationResult& result, const ResultFacts& facts) {
  const std::string wrong = facts.subject + " " + areWrong(result), remedy = remedyText(result);
  const std::string end = remedy.empty() ? "." : ". " + remedy + ".";
  if (const std::string worst = worstMotor(result); !worst.empty())
    return wrong + ": " + worst + (facts.wrong.cause.empty() ? "" : inPrint(facts.wrong, ". ")) + end;
  if (!facts.wrong.cause.empty()) return wrong + inPrint(facts.wrong, ": ") + end;
  const Check* worst = worstCheck(result.checks);
  if (worst == nullptr) return "No check was made.";
  const std::string numbers = std::isfinite(worst->value) && std::isfinite(worst->limit)
                                  ? fmt::format("off by {}, where {} is the limit", quantity(worst->value, worst->unit),
                                                quantity(worst->limit, worst->unit))
                                  : worst->why;
  const std::string title = inEffortWords(result.effort, checkWords(worst->name, result.kind).title);
  if (onlyOddEngineFails(result))
    return fmt::format("The odd one out is {}: {} and all other formulations agree. {}: {}.", inWords(result.odd_one),
                       lower(facts.subject), title, numbers);
  if (onlyFastFails(result.checks))
    return fmt::format("The fast kernels that users call are wrong, {} hold. {}: {} ({}).", lower(facts.subject), title,
                       numbers, worst->largest.where);
  return fmt::format("{} do not hold. {}: {}{}", facts.subject, title, numbers, end);
}

/// The limit at the replay's end; NaN if unknown.
double limitAtEnd(const ValidationResult& result, const Check& replay) {
  for (const Curve& curve : result.curves)
    for (const CurveLine& line : curve.lines)
      if (curve.about == Curve::About::sources && line.role == CurveLine::Role::limit && !line.values.empty())
        return line.values.back();
  return replay.value == replay.largest.value ? replay.limit : none;
}

std::string undecided(const ValidationResult& result) {
  const Check* worst = worstCheck(result.checks);
  const auto count = countOf(result.checks, Verdict::inconclusive);
  if (worst == nullptr || count == 0) return reason(result.verdict, result.checks);
  return fmt::format("Nothing failed, but {} cannot be judged here: {}.",
                     count == 1 ? "one check" : inWords(static_cast<int>(count)) + " checks", worst->why);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> findingTexts(const ValidationResult& result) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Finding& finding : result.findings) out.emplace_back(finding.name, textOf(finding));
  return out;
}

ResultFacts factsOf(const ValidationResult& result) {
  ResultFacts out;
  out.subject = ofWhom(result.subject, result.effort);
  const std::string motion = result.asked != nullptr ? result.asked->trajectory->kind() : "";
  const TrajectoryKind* kind = trajectoryKind(motion);  // motors' motions have no words of their own
  out.motion = kind != nullptr ? kind->words : motion.empty() ? "the motion" : "the motion through " + motion;
  const std::vector<double>* t = result.timeseries.find("t_s");
  out.duration = t == nullptr || t->empty() ? none : t->back();
  const Check* replay = find(result, "replay.position");
  out.replay = replay == nullptr ? none : replay->largest.value;
  out.replay_limit = replay == nullptr ? none : limitAtEnd(result, *replay);
  out.windows = std::max<int>(1, static_cast<int>(result.replay_windows));
  addEngines(result, out);
  // Efforts of a file may cover a part of the motion; they are compared with the largest of all of it.
  if (result.deviation && result.deviation->largest_effort > 0) out.agreement = result.deviation->relative();
  if (result.replay_error) out.dominant = result.replay_error->dominant;
  out.wrong = result.cause_words;
  return out;
}

std::string sentence(const ValidationResult& result) {
  const ResultFacts facts = factsOf(result);
  const std::string& name = result.subject.name;
  switch (result.verdict) {
    case Verdict::fail:
      return unbrokenBut(name, failed(result, facts));
    case Verdict::inconclusive:
      return unbroken(undecided(result));
    case Verdict::pass:
    case Verdict::not_applicable:
      break;
  }
  return unbrokenBut(name, drives(facts) + inEffortWords(result.effort, agrees(facts)) + ".");
}

std::string detail(const ValidationResult& result) {
  const ResultFacts facts = factsOf(result);
  if (result.verdict == Verdict::pass) return "";
  if (!facts.wrong.off.empty()) return capital(unbroken(facts.wrong.off)) + ".";
  const Check* worst = worstCheck(result.checks);
  const bool said = result.verdict != Verdict::fail || worst == nullptr || worst->why.empty() ||
                    !std::isfinite(worst->value) || !std::isfinite(worst->limit);
  return said ? "" : capital(unbroken(worst->why)) + ".";
}

std::vector<KeyFigure> keyFigures(const ValidationResult& result) {
  const ResultFacts facts = factsOf(result);
  std::vector<KeyFigure> out;
  const auto applicable = judgedCount(result.checks);
  out.push_back({"checks passed", fmt::format("{} of {}", countOf(result.checks, Verdict::pass), applicable),
                 fmt::format("{} failed, {} undecided", countOf(result.checks, Verdict::fail),
                             countOf(result.checks, Verdict::inconclusive))});
  if (!std::isnan(facts.replay))
    out.push_back({"off the path", quantity(facts.replay, "m"),
                   std::isnan(facts.replay_limit) ? "" : "limit " + quantity(facts.replay_limit, "m")});
  if (!std::isnan(facts.agreement))
    out.push_back({"largest effort deviation", sizeOf(facts.agreement), "of the largest effort"});
  const bool passed =
      result.verdict == Verdict::pass && facts.dominant == ErrorSource::unexplained;  // then nothing is missing
  if (facts.dominant && facts.wrong.cause.empty() && !passed)
    out.push_back(
        {"what limits it", name(*facts.dominant),
         facts.windows > 1 ? fmt::format("{} windows", facts.windows) : "largest source of the replay's error"});
  return out;
}

bool repeats(const Check& check, const Check& first) {
  constexpr double as_large = 0.01;
  if (check.verdict == Verdict::inconclusive && first.verdict == check.verdict)
    return !check.why.empty() && check.why == first.why;
  const bool fail = check.verdict == Verdict::fail && first.verdict == Verdict::fail && isOf(first, "torque");
  if (!fail || !std::isfinite(check.value) || !std::isfinite(first.value)) return false;
  if (check.name == "acceleration.pointwise") return true;
  return isOf(check, "torque") && check.unit == first.unit &&
         std::abs(check.value - first.value) <= as_large * first.value;
}

std::string causeText(const CauseWords& words) {
  return (words.claim == CauseClaim::likely ? "likely cause: " : "") + words.cause;
}

}  // namespace ursula::report
