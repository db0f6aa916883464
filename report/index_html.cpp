#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/check_catalogue.h"
#include "report/page.h"
#include "report/plots.h"
#include "report/quantity.h"
#include "report/run.h"
#include "report/sections.h"
#include "report/text.h"
#include "report/written_files.h"

namespace ursula::report {
namespace {

/// All checks of any scenario, in groups.
std::vector<std::string> columns(const std::vector<SuiteEntry>& entries) {
  std::vector<std::string> names;
  for (const SuiteEntry& entry : entries)
    for (const Check& check : entry.checks)
      if (std::find(names.begin(), names.end(), check.name) == names.end()) names.push_back(check.name);
  std::stable_sort(names.begin(), names.end(),
                   [](const std::string& a, const std::string& b) { return groupOf(a) < groupOf(b); });
  return names;
}

/// Returns one of five shades for the share of a limit: 0 below a thousandth, 4 above a third.
int shade(double share) {
  return std::isfinite(share) && share > 0 ? std::clamp(static_cast<int>(std::floor(2 * std::log10(share))) + 5, 0, 4)
                                           : 0;
}

std::string cell(const SuiteEntry& entry, const std::string& name) {
  const auto check =
      std::find_if(entry.checks.begin(), entry.checks.end(), [&name](const Check& each) { return each.name == name; });
  if (check == entry.checks.end() || check->verdict == Verdict::not_applicable)
    return "<td class=\"cell not_applicable\"><span class=\"unseen\">does not apply</span></td>";
  const char* sign = check->verdict == Verdict::fail ? "✗" : check->verdict == Verdict::inconclusive ? "?" : "";
  return fmt::format(
      "<td class=\"cell {0} shade{1}\" title=\"{2}: {0}, {3}\"><span aria-hidden=\"true\">{4}</span>"
      "<span class=\"unseen\">{0}</span></td>",
      report::escaped(ursula::name(check->verdict)), shade(limitShare(*check)), escaped(checkTitle(name)),
      escaped(standing(*check)), sign);
}

std::string deciding(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  if (!entry.error.empty()) return escaped(entry.error);
  if (worst == nullptr) return "no check was made";
  return fmt::format("{} <span class=\"aside\">{}</span>", escaped(checkTitle(worst->name)), standing(*worst));
}

/// A scenario without a result is in error, which its verdict calls a failure.
std::string badgeOf(const SuiteEntry& entry) {
  return entry.error.empty() ? verdictBadge(entry.verdict)
                             : "<span class=\"badge fail\"><span aria-hidden=\"true\">✗</span> ERROR</span>";
}

std::string row(const SuiteEntry& entry, const std::vector<std::string>& names) {
  const auto passed = std::count_if(entry.checks.begin(), entry.checks.end(),
                                    [](const Check& check) { return check.verdict == Verdict::pass; });
  const std::string link = urlPath((entry.folder / "report.html").generic_string());
  const std::string scenario = escaped(entry.scenario);
  std::string cells;
  for (const std::string& name : names) cells += cell(entry, name);
  return fmt::format(
      "<tr class=\"scenario {0}\" data-verdict=\"{0}\"><td>{1}</td><th scope=\"row\">{2}</th><td "
      "class=\"number\">{3}</td><td class=\"deciding\">{4}</td><td>{5}</td><td class=\"number\" "
      "data-value=\"{6:.3f}\">{6:.1f}</td><td>{7}</td>{8}</tr>\n",
      name(entry.verdict), badgeOf(entry),
      entry.error.empty() ? fmt::format("<a href=\"{}\">{}</a>", link, scenario) : scenario,
      entry.error.empty() ? fmt::format("{} of {}", passed, judgedCount(entry.checks)) : "–", deciding(entry),
      entry.dominant.empty() ? "–" : escaped(entry.dominant), entry.time.seconds, sparkline(entry.trend), cells);
}

int rank(Verdict verdict) { return verdict == Verdict::fail ? 0 : verdict == Verdict::inconclusive ? 1 : 2; }

/// Sorts failures first and otherwise keeps the order.
std::string rows(std::vector<SuiteEntry> entries, const std::vector<std::string>& names) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const SuiteEntry& a, const SuiteEntry& b) { return rank(a.verdict) < rank(b.verdict); });
  std::string out;
  for (const SuiteEntry& entry : entries) out += row(entry, names);
  return out;
}

std::string heads(const std::vector<std::string>& names) {
  std::string out;
  std::size_t group = checkGroups().size() + 1;
  for (const std::string& name : names) {
    out += fmt::format("<th scope=\"col\" class=\"upright{}\"><span>{}</span></th>",
                       groupOf(name) != group ? " first" : "", escaped(checkTitle(name)));
    group = groupOf(name);
  }
  return out;
}

}  // namespace

std::string indexHtml(const std::vector<SuiteEntry>& entries) {
  const std::vector<std::string> names = columns(entries);
  const Verdict verdict = suiteVerdict(entries);
  const std::string whole = fmt::format(" of {} scenario{}", entries.size(), entries.size() == 1 ? "" : "s");
  return filled(index_template, {{"style", std::string(report_style)},
                                 {"verdict", name(verdict)},
                                 {"badge", verdictBadge(verdict)},
                                 {"counts", countsOf(entries, whole) + "."},
                                 {"seconds", fmt::format("{:.1f}", secondsOf(entries))},
                                 {"run", runOf(entries)},
                                 {"heads", heads(names)},
                                 {"rows", rows(entries, names)},
                                 {"script", std::string(index_script)}});
}

}  // namespace ursula::report
