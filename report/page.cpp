#include "report/page.h"

#include <fmt/format.h>
#include <cmath>

#include "report/quantity.h"
#include "report/sections.h"
#include "report/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

std::string paragraph(const char* style, const std::string& html) {
  return html.empty() ? "" : fmt::format("<p class=\"{}\">{}</p>\n", style, html);
}

std::string figuresOf(const Page& page) {
  std::string out;
  for (const PageFigure& figure : page.figures)
    out += fmt::format("<div><dt>{}</dt><dd><b>{}</b> <span>{}</span></dd></div>", escaped(figure.what),
                       escaped(figure.value), escaped(figure.remark));
  return out.empty() ? "" : "<dl class=\"figures\">" + out + "</dl>";
}

std::string remarksOf(const Page& page) {
  std::string out;
  for (const std::string& remark : page.remarks) out += paragraph("why", escaped(remark));
  return out;
}

std::string scriptsOf(const Page& page) {
  std::string out;
  if (!page.charts.empty())
    out +=
        fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", chartData(page.title, page.charts));
  return page.script.empty() ? out : out + fmt::format("<script>{}</script>\n", page.script);
}

}  // namespace

std::string pageHtml(const Page& page) {
  std::string sections, links;
  for (const auto& [id, title, html] : page.sections) {
    if (html.empty()) continue;
    sections += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}\n</section>\n", id, escaped(title), html);
    links += fmt::format("<a href=\"#{}\">{}</a>\n", id, escaped(title));
  }
  const bool judges = page.verdict != Verdict::not_applicable;
  return filled(page_template, {{"title", escaped(page.title)},
                                {"heading", escaped(page.kind + ": " + page.title)},
                                {"style", std::string(report_style).append(page.style)},
                                {"verdict", judges ? name(page.verdict) : "unjudged"},
                                {"kind", escaped(page.kind)},
                                {"subtitle", paragraph("machine-line", escaped(page.subtitle))},
                                {"badge", judges ? paragraph("verdict", verdictBadge(page.verdict)) : ""},
                                {"sentence", paragraph("sentence", escaped(page.sentence))},
                                {"remarks", remarksOf(page)},
                                {"figures", figuresOf(page)},
                                {"links", links},
                                {"sections", sections},
                                {"footer", page.footer.empty() ? "" : "<footer>\n" + page.footer + "\n</footer>"},
                                {"scripts", scriptsOf(page)}});
}

namespace {

constexpr std::size_t most_points = 500;

const char* name(Stroke stroke) {
  return stroke == Stroke::limit ? "limit" : stroke == Stroke::ghost ? "ghost" : "line";
}

std::string lineJson(const Line& line) {
  return fmt::format(R"({{"label":{},"unit":{},"color":{},"stroke":"{}","values":{}}})", jsonText(line.label),
                     jsonText(line.unit), line.color, name(line.stroke), jsonNumbers(line.values));
}

std::string plotJson(const Plot& full) {
  const Plot plot = thinned(full, most_points);
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
