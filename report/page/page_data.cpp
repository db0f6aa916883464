#include "report/page/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/json_text.h"
#include "report/text/quantity.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_points = 500;

const char* name(Stroke stroke) {
  constexpr const char* names[] = {"line", "ghost", "limit", "points"};
  return names[static_cast<std::size_t>(stroke)];
}

Json lineJson(const Line& line) {
  return {{"label", line.label},
          {"unit", line.unit},
          {"color", line.color},
          {"stroke", name(line.stroke)},
          {"values", screenNumbers(line.values)}};
}

Json plotJson(const Plot& full) {
  const bool scattered =
      std::any_of(full.lines.begin(), full.lines.end(), [](const Line& line) { return line.stroke == Stroke::points; });
  const Plot plot = scattered ? full : thinned(full, most_points);
  Json lines = Json::array();
  for (const Line& line : plot.lines) lines.push_back(lineJson(line));
  return {{"title", plot.title},        {"xLabel", plot.x_label}, {"yLabel", plot.y_label},
          {"logX", plot.log_x},         {"logY", plot.log_y},     {"overTime", plot.over_time},
          {"tube", plot.tube},          {"rows", full.rows},      {"description", full.title + ". " + inWords(full)},
          {"x", screenNumbers(plot.x)}, {"lines", lines}};
}

Json plotsJson(const std::vector<Plot>& plots) {
  Json out = Json::array();
  for (const Plot& plot : plots) out.push_back(plotJson(plot));
  return out;
}

/// Events of the result, and the worst instants of the most important checks.
Json eventsJson(const ValidationResult& result) {
  std::vector<Event> events;  // the most important ones first
  const auto add = [&events](double t, const std::string& what, double value, const std::string& unit) {
    if (std::isfinite(value) && value > 0) events.push_back({t, what + quantity(value, unit)});
  };
  if (const auto& deviation = result.deviation)
    add(deviation->t, inEffortWords(result.effort, "largest effort deviation, "), deviation->largest, deviation->unit);
  for (const Check& check : result.checks)
    if (check.name == "replay.position")
      add(check.largest.t, "largest replay error, ", check.largest.value, check.unit);
  events.insert(events.end(), result.events.begin(), result.events.end());
  Json out = Json::array();
  for (const Event& event : events) out.push_back({{"t", screenNumber(event.t)}, {"what", event.what}});
  return out;
}

}  // namespace

std::string inScript(const nlohmann::ordered_json& json) {
  std::string out = jsonText(json);
  for (const auto& [odd, escape] :
       {std::pair<std::string, const char*>{"<", "\\u003c"}, {"\xEF\xBF\xBE", "\\ufffe"}, {"\xEF\xBF\xBF", "\\uffff"}})
    for (std::size_t at = out.find(odd); at != std::string::npos; at = out.find(odd, at))
      out.replace(at, odd.size(), escape);
  return out;
}

nlohmann::ordered_json screenNumber(double value) {
  return std::isfinite(value) ? Json::parse(fmt::format("{:.6g}", value)) : Json();
}

nlohmann::ordered_json screenNumbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(screenNumber(value));
  return out;
}

std::string chartData(const std::string& title, const std::vector<Plot>& plots) {
  return inScript({{"scenario", title}, {"events", Json::array()}, {"plots", plotsJson(plots)}});
}

std::string pageData(const ValidationResult& result, const Picture* picture, const std::vector<Plot>& plots) {
  const Json machine = picture != nullptr            ? machineJson(*picture, result)
                       : result.mechanism != nullptr ? machineJson(*result.mechanism, result)
                                                     : Json();
  return inScript({{"scenario", result.scenario},
                   {"events", eventsJson(result)},
                   {"machine", machine},
                   {"plots", plotsJson(plots)}});
}

}  // namespace ursula::report
