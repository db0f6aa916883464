#include "validation/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "validation/report/assets.h"
#include "validation/report/checks_table.h"
#include "validation/report/plots.h"
#include "validation/report/text.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

// "<" never appears, so neither "</script" nor "<!--" can end or derail the block that holds it.
std::string scriptJson(const Json& json) {
  std::string result;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    result += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return result;
}

Json plotJson(const Plot& plot) {
  Json lines = Json::array();
  for (const Line& line : plot.lines) {
    lines.push_back({{"label", line.label},
                     {"unit", line.unit},
                     {"color", line.color},
                     {"ghost", line.ghost},
                     {"values", line.values}});
  }
  return {{"xLabel", plot.x_label},
          {"yLabel", plot.y_label},
          {"logX", plot.log_x},
          {"logY", plot.log_y},
          {"overTime", plot.over_time},
          {"description", plot.title + ". " + inWords(plot)},
          {"x", plot.x},
          {"lines", lines}};
}

std::string figures(const std::vector<Plot>& plots) {
  std::string html;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const Plot& plot = plots[i];
    const bool drawable =
        std::any_of(plot.lines.begin(), plot.lines.end(), [&plot](const Line& line) { return isDrawable(plot, line); });
    html += fmt::format("<figure><figcaption><h3>{}</h3><p>{}</p></figcaption>{}</figure>\n", escaped(plot.title),
                        escaped(inWords(plot)), drawable ? fmt::format("<div data-plot=\"{}\"></div>", i) : "");
  }
  return html;
}

std::string factsTable(const char* caption, const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string rows;
  for (const auto& [key, text] : facts) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(key), escaped(text));
  }
  return fmt::format("<table class=\"facts\">\n<caption>{}</caption>\n<tbody>\n{}</tbody>\n</table>", caption, rows);
}

std::string section(const char* title, const std::string& content) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}\n</section>\n", title, content);
}

std::string worstFinding(const ValidationResult& result) {
  const Check* worst = worstCheck(result.checks);
  if (worst == nullptr || worst->verdict == Verdict::pass || worst->why.empty()) return "";
  return fmt::format("<p class=\"why\"><b>{}:</b> {}</p>", escaped(worst->name), escaped(worst->why));
}

std::string deciding(const Check& check) {
  return fmt::format("{} <span class=\"aside\">{}</span>", escaped(check.name), standing(check));
}

std::string suiteRow(const SuiteEntry& entry) {
  const Check* worst = worstCheck(entry.checks);
  const auto passed = std::count_if(entry.checks.begin(), entry.checks.end(),
                                    [](const Check& check) { return check.verdict == Verdict::pass; });
  const std::string link = urlPath((entry.folder / "report.html").generic_string());
  const std::string scenario = escaped(entry.scenario);
  return fmt::format(
      "<tr class=\"scenario {}\"><td>{}</td><th scope=\"row\">{}</th><td class=\"number\">{}</td><td>{}</td>"
      "<td>{}</td></tr>\n",
      name(entry.verdict), verdictBadge(entry.verdict),
      entry.error.empty() ? fmt::format("<a href=\"{}\">{}</a>", link, scenario) : scenario,
      fmt::format("{} of {}", passed, judgedCount(entry.checks)),
      !entry.error.empty() ? escaped(entry.error)
      : worst != nullptr   ? deciding(*worst)
                           : "no check was made",
      entry.dominant.empty() ? "–" : escaped(entry.dominant));
}

std::string suiteCounts(const std::vector<SuiteEntry>& entries) {
  const auto count = [&entries](Verdict verdict) {
    return std::count_if(entries.begin(), entries.end(),
                         [verdict](const SuiteEntry& entry) { return entry.verdict == verdict; });
  };
  return fmt::format("{} of {} scenario{} passed, {} failed, {} inconclusive.", count(Verdict::pass), entries.size(),
                     entries.size() == 1 ? "" : "s", count(Verdict::fail), count(Verdict::inconclusive));
}

// As for checks: nothing validated is not a success.
Verdict suiteVerdict(const std::vector<SuiteEntry>& entries) {
  std::vector<Check> verdicts;
  for (const SuiteEntry& entry : entries) {
    verdicts.emplace_back();
    verdicts.back().verdict = entry.verdict;
  }
  return overall(verdicts);
}

}  // namespace

std::string reportHtml(const ValidationResult& result) {
  const std::vector<Plot> charts = plots(result);
  Json data = Json::array();
  for (const Plot& plot : charts) data.push_back(plotJson(plot));
  const std::string no_script =
      "<noscript><p>The charts need JavaScript; their numbers are in timeseries.csv.</p></noscript>";
  return filled(
      report_template,
      {{"scenario", escaped(result.scenario)},
       {"style", std::string(report_style)},
       {"verdict", name(result.verdict)},
       {"badge", verdictBadge(result.verdict)},
       {"reason", escaped(reason(result.verdict, result.checks))},
       {"why", worstFinding(result)},
       {"checks", section("Checks", checksTable(result.checks))},
       {"findings",
        result.findings.empty() ? "" : section("Findings", factsTable("Facts that are not judged", result.findings))},
       {"plots",
        charts.empty() ? "" : section("Charts", no_script + "<div class=\"charts\">\n" + figures(charts) + "</div>")},
       {"provenance", section("Provenance", factsTable("What this result was made from and with", result.provenance))},
       {"data", scriptJson(data)},
       {"script", std::string(report_script)}});
}

std::string indexHtml(const std::vector<SuiteEntry>& entries) {
  std::string rows;
  for (const SuiteEntry& entry : entries) rows += suiteRow(entry);
  const Verdict verdict = suiteVerdict(entries);
  return filled(index_template, {{"style", std::string(report_style)},
                                 {"verdict", name(verdict)},
                                 {"badge", verdictBadge(verdict)},
                                 {"counts", suiteCounts(entries)},
                                 {"rows", rows}});
}

}  // namespace ursula::report
