#include "report/sections.h"

#include <fmt/format.h>

#include <cmath>

#include "report/json_text.h"
#include "report/quantity.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

constexpr std::size_t buckets = 500;

const char* name(Stroke stroke) {
  return stroke == Stroke::limit ? "limit" : stroke == Stroke::ghost ? "ghost" : "line";
}

std::string lineJson(const Line& line) {
  return fmt::format(R"({{"label":{},"unit":{},"color":{},"stroke":"{}","values":{}}})", jsonText(line.label),
                     jsonText(line.unit), line.color, name(line.stroke), jsonNumbers(line.values));
}

std::string plotJson(const Plot& full) {
  const Plot plot = thinned(full, buckets);
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
