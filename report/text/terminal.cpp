#include "report/text/terminal.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "model/check_catalogue.h"
#include "report/files/written_files.h"
#include "report/page/sections.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

constexpr std::size_t verdict_width = 12;  // "inconclusive"

Paint paintOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return Paint::good;
    case Verdict::fail:
      return Paint::bad;
    case Verdict::inconclusive:
      return Paint::open;
    case Verdict::not_applicable:
      break;
  }
  return Paint::quiet;
}

std::string paintedVerdict(Verdict verdict, bool coloured) {
  return painted(name(verdict), paintOf(verdict), coloured);
}

bool isShown(const Check& check) {
  return check.verdict != Verdict::not_applicable || check.reason == Reason::reported;
}

/// Whether the check needs attention, so that its explanation is shown.
bool isOpen(const Check& check) { return check.verdict == Verdict::fail || check.verdict == Verdict::inconclusive; }

std::string numberText(double value) {
  if (std::isnan(value)) return "–";
  return std::isinf(value) ? "infinite" : fmt::format("{:.3g}", value);
}

/// The value's share of its limit; empty if they did not decide the check.
std::string limitShareText(const Check& check) {
  const double share = limitShare(check);
  if (check.verdict == Verdict::inconclusive || check.verdict == Verdict::not_applicable || std::isnan(share))
    return "";
  if (std::isinf(share)) return "beyond";
  if (share > 1) return share < 1000 ? fmt::format("{:.3g} times", share) : fmt::format("{:.1e} times", share);
  if (share >= 0.1) return fmt::format("{:.0f} %", 100 * share);
  return share == 0 ? "0 %" : share < 1e-4 ? "< 0.01 %" : fmt::format("{:.2g} %", 100 * share);
}

/// A value that mixes forces and moments has no readable unit, so only the share is shown.
std::vector<std::string> tableRow(const Check& check) {
  const bool mixed = check.unit.find(',') != std::string::npos;
  const bool unnumbered = std::isnan(check.value) && std::isnan(check.limit);
  const std::string value = mixed || unnumbered ? "" : numberText(check.value);
  const std::string limit = mixed || unnumbered || check.reason == Reason::reported ? "" : numberText(check.limit);
  return {check.name, value, limit, mixed || unnumbered ? "" : prettyUnit(check.unit), limitShareText(check)};
}

std::string verdictWord(const Check& check) {
  return check.reason == Reason::reported ? "not judged" : std::string(name(check.verdict));
}

/// The reason in one line; the cause is printed once, below.
std::string whyLine(const Check& check) {
  std::string why = check.why;
  std::replace(why.begin(), why.end(), '\n', ' ');
  if (!why.empty()) return prettyUnit(why);
  return std::isnan(check.value) ? "it has no value" : standing(check);
}

std::string indented(std::size_t columns, const std::string& text) { return std::string(columns, ' ') + text + "\n"; }

/// Returns a group's text, in which adjacent checks with the same reason share its line.
std::string groupText(const std::vector<const Check*>& checks, const std::vector<std::string>& lines, bool coloured,
                      std::size_t indent) {
  std::string out;
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const Check& check = *checks[k];
    const Paint paint = check.reason == Reason::reported ? Paint::quiet : paintOf(check.verdict);
    out += indented(indent, painted(padded(verdictWord(check), verdict_width), paint, coloured) + "  " + lines[k]);
    if (!isOpen(check)) continue;
    const std::string why = whyLine(check);
    const bool said_next = k + 1 < checks.size() && isOpen(*checks[k + 1]) && whyLine(*checks[k + 1]) == why;
    if (!said_next) out += indented(indent + verdict_width + 2, painted(why, paint, coloured));
  }
  return out;
}

using Group = std::vector<const Check*>;

std::vector<Group> shownGroups(const ValidationResult& result) {
  std::vector<Group> out(checkGroups().size() + 1);
  for (const Check& check : result.checks)
    if (isShown(check)) out[groupOf(check.name)].push_back(&check);
  return out;
}

std::string groupTitle(const ValidationResult& result, std::size_t k) {
  return inEffortWords(result.effort, k < checkGroups().size() ? checkGroups()[k] : "Further checks");
}

/// "18 checks, invariance.engines at 16 % of its limit", of checks that all pass.
std::string passedText(const Group& passed) {
  const auto share = [](const Check* check) { return std::isnan(limitShare(*check)) ? 0 : limitShare(*check); };
  const Check& closest = **std::max_element(passed.begin(), passed.end(),
                                            [&](const Check* a, const Check* b) { return share(a) < share(b); });
  const std::string of_limit = limitShareText(closest);
  return fmt::format("{} check{}{}", passed.size(), passed.size() == 1 ? "" : "s",
                     of_limit.empty() ? "" : fmt::format(", {} at {} of its limit", closest.name, of_limit));
}

/// A line for each group; of groups with open checks also these.
std::string groupsText(const ValidationResult& result, bool coloured) {
  const std::vector<Group> groups = shownGroups(result);
  std::size_t width = 0;
  for (std::size_t k = 0; k < groups.size(); ++k) width = std::max(width, columnsOf(groupTitle(result, k)));
  std::string out;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (groups[k].empty()) continue;
    Group passed, others;
    std::string repeated;
    for (const Check* check : groups[k]) {
      if (!others.empty() && repeats(*check, *others.front()))
        repeated += (repeated.empty() ? "the same: " : ", ") + check->name;
      else
        (check->verdict == Verdict::pass ? passed : others).push_back(check);
    }
    const Check* worst = others.empty() ? passed.front() : others.front();
    for (const Check* check : others)
      if (check->verdict == Verdict::fail) worst = check;
    const Paint paint = worst->reason == Reason::reported ? Paint::quiet : paintOf(worst->verdict);
    out += "  " + painted(padded(verdictWord(*worst), verdict_width), paint, coloured) + "  " +
           padded(groupTitle(result, k), width) + "  " +
           (others.empty() ? passedText(passed)
                           : fmt::format("{} of {}", groups[k].size() - passed.size(), groups[k].size())) +
           "\n";
    std::vector<std::vector<std::string>> rows;
    for (const Check* check : others) rows.push_back(tableRow(*check));
    out += groupText(others, alignedRows(rows, {Align::left, Align::right, Align::right, Align::left, Align::right}),
                     coloured, 4);
    if (!repeated.empty()) out += indented(4 + verdict_width + 2, painted(repeated, paint, coloured));
  }
  return out;
}

std::string checksTable(const ValidationResult& result, bool coloured) {
  const std::vector<Group> groups = shownGroups(result);
  std::vector<std::vector<std::string>> rows = {{"", "value", "limit", "unit", "of limit"}};
  for (const Group& group : groups)
    for (const Check* check : group) rows.push_back(tableRow(*check));
  const std::vector<std::string> lines =
      alignedRows(rows, {Align::left, Align::right, Align::right, Align::left, Align::right});
  std::string out = indented(verdict_width + 4, painted(lines.front(), Paint::quiet, coloured));
  auto line = lines.begin() + 1;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (groups[k].empty()) continue;
    const auto end = line + static_cast<std::ptrdiff_t>(groups[k].size());
    out += painted(groupTitle(result, k), Paint::strong, coloured) + "\n";
    out += groupText(groups[k], {line, end}, coloured, 2);
    line = end;
  }
  return out;
}

std::string notApplicableText(const std::vector<Check>& checks) {
  std::map<std::string, std::string> names;  // keyed by reason
  for (const Check& check : checks) {
    if (isShown(check)) continue;
    std::string& of = names[check.reason == Reason::not_covered ? check.why : "not applicable, since " + check.why];
    of += (of.empty() ? "" : ", ") + check.name;
  }
  std::string out;
  for (const auto& [why, which] : names) out += wrapped(why + ": ", 2, which);
  return out.empty() ? "" : "\n" + out;
}

/// How many checks were not made, in one line.
std::string leftOutText(const std::vector<Check>& checks) {
  const auto count = std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !isShown(check); });
  if (count == 0) return "";
  return fmt::format("  {} here or {} not made; --verbose says why\n",
                     count == 1 ? "1 check does not apply" : fmt::format("{} checks do not apply", count),
                     count == 1 ? "was" : "were");
}

/// The deviation of each motor as a table, because six of them in one line are unreadable.
std::string motorsText(const std::vector<MotorDeviation>& motors, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows = {{"motor", "off by", "at t", "factor", "offset"}};
  for (const MotorDeviation& motor : motors)
    rows.push_back({withoutControls(motorName(names, motor.motor)),
                    motor.right ? "within its limit" : fmt::format("{:.3g} {}", motor.largest, prettyUnit(motor.unit)),
                    motor.right ? "" : fmt::format("{:.4g} s", motor.t), motor.factor ? factorText(*motor.factor) : "",
                    motor.offset ? fmt::format("{:.6g} {}", *motor.offset, prettyUnit(motor.unit)) : ""});
  std::vector<Align> columns(5, Align::right);
  if (!names.empty()) columns[0] = Align::left;
  std::string out;
  for (const std::string& line : alignedRows(rows, columns)) out += "  " + line + "\n";
  return out;
}

/// The sources of the replay's error, one per line.
std::string replayText(const ReplayError& found, const ValidationResult& result) {
  std::string out = std::string("dominant error: ") + name(found.dominant);
  const bool are_right = onlyOddEngineFails(result);
  const std::string model = are_right ? result.odd_one.engine() : result.effort + "s";
  if (found.dominant == ErrorSource::model && !found.measured)
    out += are_right ? ": " + model + " is wrong" : ": the " + model + " are wrong";
  out += "\n";
  if (!found.measured) return out;
  std::vector<std::vector<std::string>> rows;
  for (const auto& [source, share] : {std::pair<std::string, SourceOfError>("rounding", found.rounding),
                                      {"integration", found.integration},
                                      {"gaps", found.closure},
                                      {model, found.model}})
    rows.push_back({source, fmt::format("{:.3g} m", share.error), fmt::format("± {:.2g} m", share.uncertainty)});
  rows.push_back({"the rest", fmt::format("{:.3g} m", found.unexplained), ""});
  out +=
      fmt::format("  the replay is off by {:.3g} m at t = {:.6g} s, where deviations have grown {:.4g}-fold; of it\n",
                  found.observed, found.t, found.amplification);
  for (const std::string& line : alignedRows(rows, {Align::left, Align::right, Align::left})) out += "  " + line + "\n";
  return out;
}

bool replayIsOpen(const std::vector<Check>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const Check& check) { return isOpen(check) && isOf(check, "replay"); });
}

/// Returns details of the replay and of wrong torques; right torques need none.
std::string reasonsText(const ValidationResult& result) {
  std::string out;
  if (result.replay_error && replayIsOpen(result.checks)) out += replayText(*result.replay_error, result);
  if (const std::vector<MotorDeviation> motors = motorsOff(result); !motors.empty())
    out += result.effort + "s against the expected ones:\n" + motorsText(motors, motorNames(result));
  return out.empty() ? "" : "\n" + out;
}

/// The verdict, what is wrong, why, and how much.
std::string headText(const ValidationResult& result, const std::string& verdict) {
  const std::string worst = worstMotor(result), size = sizeText(result), remedy = remedyText(result);
  std::string out = fmt::format("{}: {}\nverdict: {} — {}\n", withoutControls(result.scenario), verdict, verdict,
                                reason(result.verdict, result.checks));
  if (!worst.empty()) out += fmt::format("worst: {}\n", withoutControls(worst));
  if (!result.cause_words.cause.empty()) out += prettyUnit(causeText(result.cause_words)) + "\n";
  if (!remedy.empty()) out += "remedy: " + withoutControls(remedy) + "\n";
  if (!size.empty()) out += "size: " + size + "\n";
  for (const std::string& line : deviationLines(result)) out += prettyUnit(line) + "\n";
  return out;
}

std::string quietHead(const SuiteEntry& entry, bool coloured) {
  const Check* worst = worstCheck(entry.checks);
  const bool open = entry.verdict == Verdict::inconclusive && worst != nullptr && worst->verdict == entry.verdict;
  return fmt::format("{}: {} — {}{}", withoutControls(entry.scenario), paintedVerdict(entry.verdict, coloured),
                     reason(entry.verdict, entry.checks), open ? " " + whyLine(*worst) : "");
}

std::string inOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + "\n";
}

}  // namespace

std::string validationText(const ValidationResult& result, bool coloured, bool verbose) {
  const std::string checks = verbose ? checksTable(result, coloured) + notApplicableText(result.checks)
                                     : groupsText(result, coloured) + leftOutText(result.checks);
  return headText(result, paintedVerdict(result.verdict, coloured)) + "\n" + checks + reasonsText(result);
}

std::string quietText(const ValidationResult& result, bool coloured) {
  std::string out = quietHead(suiteEntry(result, ""), coloured);
  const CauseWords& words = result.cause_words;
  if (!words.cause.empty() && out.back() == '.') out.pop_back();
  if (const std::string worst = worstMotor(result); !worst.empty()) out += " — " + withoutControls(worst);
  if (!words.cause.empty()) out += "; " + prettyUnit(causeText(words));
  if (const std::string remedy = remedyText(result); !remedy.empty()) out += ". " + withoutControls(remedy);
  return inOneLine(out);
}

std::string quietText(const SuiteEntry& entry, bool coloured) {
  if (!entry.error.empty())
    return inOneLine(fmt::format("{}: {} — {}", withoutControls(entry.scenario), painted("error", Paint::bad, coloured),
                                 entry.error));
  return inOneLine(quietHead(entry, coloured));
}

bool wantsColour(bool is_terminal, const char* no_color, const char* term) {
  const bool refused = no_color != nullptr && *no_color != '\0';
  return is_terminal && !refused && (term == nullptr || std::string(term) != "dumb");
}

namespace {

Paint paintOf(const SuiteEntry& entry) {
  if (!entry.error.empty() || entry.verdict == Verdict::fail) return Paint::bad;
  return entry.verdict == Verdict::pass ? Paint::good : Paint::open;
}

std::string entryReason(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  if (!entry.error.empty()) return entry.error;
  return worst == nullptr ? "no check was made" : worst->name + " " + standing(*worst);
}

}  // namespace

std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured) {
  std::size_t width = 0;
  for (const SuiteEntry& entry : entries) width = std::max(width, columnsOf(entry.scenario));
  std::string out;
  for (const SuiteEntry& entry : entries)
    out += fmt::format("{}  {}  {}  {}\n", painted(padded(wordOf(entry), verdict_width), paintOf(entry), coloured),
                       padded(entry.scenario, width), entryReason(entry),
                       entry.error.empty() ? (dir / entry.folder / "report.html").string() : "no report");
  return out + countsOf(entries) + "\nindex: " + (dir / "index.html").string() + "\n";
}

}  // namespace ursula::report
