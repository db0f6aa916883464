#include "report/page.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "report/html_template.h"
#include "report/quantity.h"
#include "report/sections.h"
#include "report/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {

extern const std::string_view figures_html, links_html, page_html, sections_html;  // of web/

namespace {

std::vector<HtmlValue> valuesOf(const std::vector<PageSection>& sections) {
  std::vector<HtmlValue> out;
  for (const auto& [id, title, html] : sections)
    if (!html.empty()) out.push_back({{"id", id}, {"title", title}, {"html", html}});
  return out;
}

}  // namespace

std::string keyFiguresHtml(const std::vector<PageFigure>& figures) {
  return rendered(figures_html,
                  {{"figures", listOf(figures, [](const PageFigure& figure) {
                      return HtmlValue{{"what", figure.what}, {"value", figure.value}, {"remark", figure.remark}};
                    })}});
}

std::string linksHtml(const std::vector<PageSection>& sections) {
  return rendered(links_html, {{"sections", valuesOf(sections)}});
}

std::string sectionsHtml(const std::vector<PageSection>& sections) {
  return rendered(sections_html, {{"sections", valuesOf(sections)}});
}

std::string pageHtml(const Page& page) {
  const bool judges = page.verdict != Verdict::not_applicable;
  return rendered(page_html, {{"kind", page.kind},
                              {"title", page.title},
                              {"style", std::string(report_style).append(page.style)},
                              {"verdict", judges ? name(page.verdict) : "unjudged"},
                              {"subtitle", page.subtitle},
                              {"badge", judges ? verdictBadge(page.verdict) : ""},
                              {"sentence", page.sentence},
                              {"remarks", page.remarks},
                              {"figures", keyFiguresHtml(page.figures)},
                              {"links", linksHtml(page.sections)},
                              {"sections", sectionsHtml(page.sections)},
                              {"footer", page.footer},
                              {"data", page.charts.empty() ? "" : chartData(page.title, page.charts)},
                              {"script", std::string(page.script)}}) +
         "\n";
}

namespace {

constexpr std::size_t most_points = 500;

const char* name(Stroke stroke) {
  constexpr const char* names[] = {"line", "ghost", "limit", "points"};
  return names[static_cast<std::size_t>(stroke)];
}

std::string lineJson(const Line& line) {
  return fmt::format(R"({{"label":{},"unit":{},"color":{},"stroke":"{}","values":{}}})", jsonText(line.label),
                     jsonText(line.unit), line.color, name(line.stroke), jsonNumbers(line.values));
}

std::string plotJson(const Plot& full) {
  const bool scattered =
      std::any_of(full.lines.begin(), full.lines.end(), [](const Line& line) { return line.stroke == Stroke::points; });
  const Plot plot = scattered ? full : thinned(full, most_points);
  return fmt::format(
      R"({{"title":{},"xLabel":{},"yLabel":{},"logX":{},"logY":{},"overTime":{},"tube":{},"rows":{},"description":{},"x":{},"lines":{}}})",
      jsonText(plot.title), jsonText(plot.x_label), jsonText(plot.y_label), plot.log_x, plot.log_y, plot.over_time,
      plot.tube, full.rows, jsonText(full.title + ". " + inWords(full)), jsonNumbers(plot.x),
      jsonList(plot.lines, [](const Line& line, std::string& out) { out += lineJson(line); }));
}

/// Events of the result, and the worst instants of the most important checks.
std::string eventsJson(const ValidationResult& result) {
  std::vector<Event> events = result.events;
  const auto add = [&events](double t, const std::string& what, double value, const std::string& unit) {
    if (std::isfinite(value) && value > 0) events.push_back({t, what + quantity(value, unit)});
  };
  if (const auto& deviation = result.deviation)
    add(deviation->t, inEffortWords(effortNoun(result), "largest effort deviation, "), deviation->largest,
        deviation->unit);
  for (const Check& check : result.checks)
    if (check.name == "replay.position")
      add(check.largest.t, "largest replay error, ", check.largest.value, check.unit);
  return jsonList(events, [](const Event& event, std::string& out) {
    out += R"({"t":)";
    addNumber(event.t, out);
    out += R"(,"what":)" + jsonText(event.what) + "}";
  });
}

std::string plotsJson(const std::vector<Plot>& plots) {
  return jsonList(plots, [](const Plot& plot, std::string& out) { out += plotJson(plot); });
}

}  // namespace

std::string chartData(const std::string& title, const std::vector<Plot>& plots) {
  return fmt::format(R"({{"scenario":{},"events":[],"plots":{}}})", jsonText(title), plotsJson(plots));
}

std::string pageData(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots) {
  return fmt::format(R"({{"scenario":{},"events":{},"machine":{},"plots":{}}})", jsonText(result.scenario),
                     eventsJson(result), picture != nullptr ? machineJson(*picture, result) : "null", plotsJson(plots));
}

}  // namespace ursula::report
