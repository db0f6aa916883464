#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/check_catalogue.h"
#include "report/files/run.h"
#include "report/files/written_files.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/plots.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view index_html;  // of web/

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

HtmlValue cell(const SuiteEntry& entry, const std::string& name) {
  const Check* check = findCheck(entry.checks, name);
  if (check == nullptr || check->verdict == Verdict::not_applicable) return {{"applies", false}};
  return {{"applies", true},
          {"verdict", ursula::name(check->verdict)},
          {"shade", shade(limitShare(*check))},
          {"title", checkTitle(name)},
          {"standing", standing(*check)},
          {"sign", check->verdict == Verdict::fail           ? "✗"
                   : check->verdict == Verdict::inconclusive ? "?"
                                                             : ""}};
}

HtmlValue row(const SuiteEntry& entry, const std::vector<std::string>& names) {
  const auto passed = countOf(entry.checks, Verdict::pass);
  const Check* worst = worstCheck(entry.checks);
  const bool judged = entry.error.empty();
  const std::string title = worst == nullptr ? "no check was made" : checkTitle(worst->name);
  return {{"verdict", name(entry.verdict)},
          {"badge", judged ? verdictBadge(entry.verdict) : badge(Verdict::fail, "ERROR")},
          {"link", judged ? urlPath((entry.folder / "report.html").generic_string()) : ""},
          {"scenario", entry.scenario},
          {"passed", judged ? fmt::format("{} of {}", passed, judgedCount(entry.checks)) : "–"},
          {"deciding", judged ? title : entry.error},
          {"standing", judged && worst != nullptr ? standing(*worst) : ""},
          {"dominant", entry.dominant.empty() ? "–" : entry.dominant},
          {"milliseconds", fmt::format("{:.3f}", entry.time.seconds)},
          {"seconds", fmt::format("{:.1f}", entry.time.seconds)},
          {"trend", sparkline(entry.trend)},
          {"cells", listOf(names, [&entry](const std::string& each) { return cell(entry, each); })}};
}

int rank(Verdict verdict) { return verdict == Verdict::fail ? 0 : verdict == Verdict::inconclusive ? 1 : 2; }

/// Sorts failures first and otherwise keeps the order.
std::vector<SuiteEntry> inOrder(std::vector<SuiteEntry> entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const SuiteEntry& a, const SuiteEntry& b) { return rank(a.verdict) < rank(b.verdict); });
  return entries;
}

std::vector<HtmlValue> heads(const std::vector<std::string>& names) {
  std::vector<HtmlValue> out;
  std::size_t group = checkGroups().size() + 1;
  for (const std::string& name : names) {
    out.push_back({{"first", groupOf(name) != group}, {"title", checkTitle(name)}});
    group = groupOf(name);
  }
  return out;
}

}  // namespace

std::string indexHtml(const std::vector<SuiteEntry>& entries) {
  const std::vector<std::string> names = columns(entries);
  const Verdict verdict = suiteVerdict(entries);
  const std::string whole = fmt::format(" of {} scenario{}", entries.size(), entries.size() == 1 ? "" : "s");
  const auto row_of = [&names](const SuiteEntry& entry) { return row(entry, names); };
  return rendered(index_html, {{"style", std::string(report_style)},
                               {"verdict", name(verdict)},
                               {"badge", verdictBadge(verdict)},
                               {"counts", countsOf(entries, whole) + "."},
                               {"seconds", fmt::format("{:.1f}", secondsOf(entries))},
                               {"run", runOf(entries)},
                               {"columns", heads(names)},
                               {"rows", listOf(inOrder(entries), row_of)},
                               {"script", std::string(index_script)}}) +
         "\n";
}

}  // namespace ursula::report
