#include "report/page/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/page/html_template.h"
#include "report/page/plots.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {

extern const std::string_view statistics_html;  // of web/

namespace {

struct Statistics {
  double largest = 0, at = 0, rms = 0, last = 0;
  std::size_t count = 0;
};

Statistics statisticsOf(const std::vector<double>& t, const std::vector<double>& values) {
  Statistics out;
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) continue;
    const double size = std::abs(values[k]);
    if (size > out.largest) out.largest = size, out.at = t[k];
    sum += size * size;
    out.last = size;
    ++out.count;
  }
  if (out.count > 0) out.rms = std::sqrt(sum / static_cast<double>(out.count));
  return out;
}

/// Twelve half decades up to the largest; the first bin also counts smaller values and zeros.
std::string histogram(const std::vector<double>& values, double largest) {
  constexpr int bins = 12;
  std::array<int, bins> counts{};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    const double below = value == 0 ? bins : 2 * std::log10(largest / std::abs(value));
    ++counts[static_cast<std::size_t>(std::clamp(bins - 1 - static_cast<int>(below), 0, bins - 1))];
  }
  const int most = *std::max_element(counts.begin(), counts.end());
  std::string bars;
  for (int k = 0; k < bins; ++k) {
    const double high = most > 0 ? 22.0 * counts[k] / most : 0;
    bars += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"8\" height=\"{:.1f}\"/>", 10 * k, 24 - high, high);
  }
  return fmt::format(
      "<svg class=\"histogram\" viewBox=\"0 0 120 26\" role=\"img\" aria-label=\"Histogram of six decades up to "
      "{}\">{}<path d=\"M0 25H120\"/></svg>",
      plainNumber(largest, 2), bars);
}

/// `judged` is the same error at the instants that a check judges, if it does; its maximum is the one shown.
void addRow(const std::string& what, const std::string& unit, const std::vector<double>& t,
            const std::vector<double>& values, const Check* judged, std::vector<HtmlValue>& rows) {
  Statistics s = statisticsOf(t, values);
  if (s.count == 0) return;
  if (judged != nullptr && judged->largest.value > s.largest)
    s.largest = judged->largest.value, s.at = judged->largest.t;
  rows.push_back({{"what", what},
                  {"largest", quantity(s.largest, unit)},
                  {"at", quantity(s.at, "s")},
                  {"rms", quantity(s.rms, unit)},
                  {"last", quantity(s.last, unit)},
                  {"histogram", s.largest > 0 ? histogram(values, s.largest) : ""}});
}

}  // namespace

std::string statisticsTable(const ValidationResult& result) {
  const TimeSeries& series = result.timeseries;
  const std::vector<double>* t = series.find("t_s");
  if (t == nullptr) return "";
  std::vector<HtmlValue> rows;
  const std::array<std::array<const char*, 4>, 6> columns{
      {{"error_p_m", "Replay, position", "m", "replay.position"},
       {"error_q_rad", "Replay, orientation", "rad", "replay.orientation"},
       {"error_acceleration_m_s2", "Acceleration", "m/s^2", ""},
       {"closure_p_m", "Gap of the loops", "m", ""},
       {"closure_v_m_s", "Gap of the loops, rate", "m/s", ""},
       {"error_energy_J", "Energy less work", "J", ""}}};
  for (const auto& [column, what, unit, check] : columns) {
    if (const std::vector<double>* values = series.find(column))
      addRow(what, unit, *t, *values, findCheck(result.checks, check), rows);
  }
  const std::vector<std::string> names = motorNames(result);
  const std::vector<Indexed> efforts = indexed(series, "tau"), expected = indexed(series, "simbody_tau");
  for (std::size_t k = 0; k < efforts.size() && k < expected.size(); ++k) {
    std::vector<double> off;
    for (std::size_t i = 0; i < t->size(); ++i) off.push_back((*efforts[k].values)[i] - (*expected[k].values)[i]);
    addRow("Effort of " + (names.empty() ? "motor " + efforts[k].index : motorName(names, k)),
           prettyUnit(efforts[k].unit), *t, off, nullptr, rows);
  }
  return rows.empty() ? "" : rendered(statistics_html, {{"rows", rows}});
}

}  // namespace ursula::report
