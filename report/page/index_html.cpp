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
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view index_html;  // of web/

namespace {

/// All checks of any scenario that apply, in groups.
std::vector<std::string> columns(const std::vector<SuiteEntry>& entries) {
  std::vector<std::string> names;
  for (const SuiteEntry& entry : entries)
    for (const Check& check : entry.checks)
      if (check.verdict != Verdict::not_applicable && std::find(names.begin(), names.end(), check.name) == names.end())
        names.push_back(check.name);
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
          {"title", checkWords(name, entry.kind).title},
          {"standing", unbroken(standing(*check))},
          {"sign", check->verdict == Verdict::fail           ? "✗"
                   : check->verdict == Verdict::inconclusive ? "?"
                                                             : ""}};
}

/// Why: the likely cause, or else the check that decides and how it stands.
std::string reasonOf(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  if (!entry.error.empty())
    return unbroken(entry.error.substr(0, entry.error.find('\n')));  // without the line of its place
  if (!entry.cause.empty()) {
    const std::string nearly = ", which explains more than 99.9999 % of the deviation";
    const std::size_t at = entry.cause.find(nearly);
    return unbroken(at == std::string::npos ? entry.cause
                                            : entry.cause.substr(0, at) + entry.cause.substr(at + nearly.size()));
  }
  if (worst == nullptr) return "no check was made";
  return checkWords(worst->name, entry.kind).title + " " + unbroken(standing(*worst));
}

HtmlValue row(const SuiteEntry& entry) {
  const auto passed = countOf(entry.checks, Verdict::pass);
  const bool judged = entry.error.empty();
  return {{"verdict", name(entry.verdict)},
          {"badge", judged ? verdictBadge(entry.verdict) : badge(Verdict::fail, "ERROR")},
          {"link", judged ? urlPath((entry.folder / "report.html").generic_string()) : ""},
          {"scenario", entry.scenario},
          {"passed", judged ? fmt::format("{} of {}", passed, judgedCount(entry.checks)) : "–"},
          {"reason", reasonOf(entry)},
          {"dominant", entry.dominant.empty() ? "–" : entry.dominant},
          {"milliseconds", fmt::format("{:.3f}", entry.time.seconds)},
          {"seconds", fmt::format("{:.1f}", entry.time.seconds)},
          {"trend", sparkline(entry.trend)}};
}

int rank(Verdict verdict) { return verdict == Verdict::fail ? 0 : verdict == Verdict::inconclusive ? 1 : 2; }

/// Sorts failures first and otherwise keeps the order.
std::vector<SuiteEntry> inOrder(std::vector<SuiteEntry> entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const SuiteEntry& a, const SuiteEntry& b) { return rank(a.verdict) < rank(b.verdict); });
  return entries;
}

/// The check in the words of the machines that it applies to.
std::string titleOf(const std::string& name, const std::vector<SuiteEntry>& entries) {
  std::string out;
  for (const SuiteEntry& entry : entries) {
    const Check* check = findCheck(entry.checks, name);
    if (check == nullptr || check->verdict == Verdict::not_applicable) continue;
    const std::string title = checkWords(name, entry.kind).title;
    if (out.find(title) == std::string::npos) out += (out.empty() ? "" : " / ") + title;
  }
  return out;
}

/// A row of the map: a check, and how each scenario stands.
HtmlValue mapRow(const std::string& name, const std::vector<SuiteEntry>& entries) {
  return {{"title", titleOf(name, entries)},
          {"cells", listOf(entries, [&name](const SuiteEntry& entry) { return cell(entry, name); })}};
}

}  // namespace

std::string indexHtml(const std::vector<SuiteEntry>& entries) {
  const std::vector<std::string> names = columns(entries);
  const Verdict verdict = suiteVerdict(entries);
  const std::string whole = fmt::format(" of {} scenario{}", entries.size(), entries.size() == 1 ? "" : "s");
  const std::vector<SuiteEntry> sorted = inOrder(entries);
  std::vector<SuiteEntry> mapped;
  std::copy_if(sorted.begin(), sorted.end(), std::back_inserter(mapped),
               [](const SuiteEntry& entry) { return entry.error.empty(); });
  return rendered(index_html,
                  {{"style", std::string(report_style)},
                   {"verdict", name(verdict)},
                   {"badge", verdictBadge(verdict)},
                   {"counts", countsOf(entries, whole) + "."},
                   {"seconds", fmt::format("{:.1f}", secondsOf(entries))},
                   {"run", runOf(entries)},
                   {"rows", listOf(sorted, row)},
                   {"columns", listOf(mapped, [](const SuiteEntry& entry) { return HtmlValue(entry.scenario); })},
                   {"checks", listOf(names, [&](const std::string& each) { return mapRow(each, mapped); })},
                   {"script", std::string(index_script)}}) +
         "\n";
}

}  // namespace ursula::report
