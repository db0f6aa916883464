#include "report/page/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mechanism_picture.h"
#include "model/scenario.h"
#include "report/page/sections.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/result_facts.h"
#include "report/text/text.h"
#include "validation/verdict/effort_words.h"

namespace ursula::report {
namespace {

constexpr double decades_for_log = 3;

/// The range of values. Zeros are ignored, because an error starts at zero, which a logarithmic axis cannot show.
struct Span {
  bool positive = true;
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

  void include(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value) || value == 0) continue;
      positive = positive && value > 0;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  bool isWide() const { return positive && most > least && std::log10(most / least) > decades_for_log; }
};

Line lineOf(const CurveLine& from, int color, const std::vector<std::size_t>& rows) {
  constexpr Stroke strokes[] = {Stroke::line, Stroke::ghost, Stroke::limit};
  return {from.label, from.unit, color, strokes[static_cast<std::size_t>(from.role)], picked(from.values, rows)};
}

/// The unit that all lines share, or "" if they differ.
std::string commonUnit(const Plot& plot) {
  for (const Line& line : plot.lines)
    if (line.unit != plot.lines.front().unit) return "";
  return plot.lines.front().unit;
}

Plot curvePlot(const Curve& curve) {
  constexpr PlotGroup groups[] = {PlotGroup::sources, PlotGroup::errors, PlotGroup::numerics};
  const std::vector<std::size_t> rows = ascending(curve.x);
  Plot plot;
  plot.title = curve.title;
  plot.group = groups[static_cast<std::size_t>(curve.about)];
  plot.over_time = curve.over_time;
  plot.x_label = curve.over_time ? "t (s)" : curve.x_label;
  plot.x = picked(curve.x, rows);
  plot.rows = rows.size();
  Span x, y;
  x.include(plot.x);
  for (const CurveLine& line : curve.lines) {
    plot.lines.push_back(lineOf(line, static_cast<int>(plot.lines.size()), rows));
    y.include(plot.lines.back().values);
  }
  const std::string unit = commonUnit(plot);
  plot.y_label = plot.lines.size() == 1 ? curve.lines[0].label : unit.empty() ? "" : (unit == "m" ? "error (m)" : unit);
  // Time has a linear axis; any other x goes with a logarithmic y, so a power law is a straight line.
  plot.log_y = y.isWide() || (!plot.over_time && x.isWide() && y.positive);
  plot.log_x = !plot.over_time && x.positive && plot.log_y;
  return plot;
}

/// The least and the largest of values[from, to), in their order; NaN if there is none.
std::pair<double, double> extremes(const std::vector<double>& values, std::size_t from, std::size_t to) {
  std::size_t low = to, high = to;
  for (std::size_t k = from; k < to; ++k) {
    if (!std::isfinite(values[k])) continue;
    if (low == to || values[k] < values[low]) low = k;
    if (high == to || values[k] > values[high]) high = k;
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (low == to) return {none, none};
  return low < high ? std::pair(values[low], values[high]) : std::pair(values[high], values[low]);
}

/// Rewrites the chart's texts with the noun for the machine's efforts.
void sayEfforts(const std::string& noun, Plot& plot) {
  for (std::string* text : {&plot.title, &plot.x_label, &plot.y_label}) *text = inEffortWords(noun, *text);
  for (Line& line : plot.lines) line.label = inEffortWords(noun, line.label);
}

}  // namespace

Motors motorsOf(const ValidationResult& result) {
  if (result.asked && result.asked->manipulator) return result.asked->manipulator->motors();
  Motors out;
  for (int k = 0; k < motor_count; ++k) out[k].leg = k;
  return out;
}

int legOf(const ValidationResult& result, int motor) { return motorsOf(result)[static_cast<std::size_t>(motor)].leg; }

std::vector<Plot> plots(const ValidationResult& result) {
  std::vector<Plot> plots;
  for (const Curve& curve : result.curves)
    if (!curve.lines.empty() && !curve.x.empty()) plots.push_back(curvePlot(curve));
  const MechanismPicture* mechanism = result.mechanism.get();
  const std::optional<MotorDeviation> worst = worstOf(motorsOff(result));
  addSeriesPlots(result.timeseries, motorsOf(result), result.deviation ? result.deviation->allowed : 0, plots,
                 motorNames(result), mechanism == nullptr ? "" : mechanism->bodies[mechanism->output].name,
                 worst ? worst->motor : -1);
  std::stable_sort(plots.begin(), plots.end(), [](const Plot& a, const Plot& b) { return a.group < b.group; });
  for (Plot& plot : plots) sayEfforts(result.effort, plot);
  return plots;
}

Plot thinned(const Plot& plot, std::size_t buckets) {
  if (plot.x.size() <= 2 * buckets) return plot;
  Plot out = plot;
  out.x.clear();
  for (Line& line : out.lines) line.values.clear();
  const std::size_t rows = plot.x.size();
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    const std::size_t from = bucket * rows / buckets, to = (bucket + 1) * rows / buckets;
    out.x.push_back(plot.x[from]);
    out.x.push_back(plot.x[to - 1]);
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
      const auto [first, second] = extremes(plot.lines[i].values, from, to);
      out.lines[i].values.push_back(first);
      out.lines[i].values.push_back(second);
    }
  }
  return out;
}

bool isDrawable(const Plot& plot, const Line& line) {
  return std::any_of(line.values.begin(), line.values.end(),
                     [&plot](double value) { return std::isfinite(value) && (value > 0 || !plot.log_y); });
}

std::string inWords(const Plot& plot) {
  if (!plot.words.empty()) return plot.words;
  const Line* largest = nullptr;
  std::size_t row = 0;
  for (const Line& line : plot.lines) {
    if (line.stroke == Stroke::limit && plot.lines.size() > 1) continue;
    if (plot.group == PlotGroup::sources && line.stroke != Stroke::ghost) continue;  // parts may cancel in the whole
    for (std::size_t i = 0; i < line.values.size() && isDrawable(plot, line); ++i) {
      const double magnitude = std::abs(line.values[i]);
      if (!std::isfinite(magnitude)) continue;
      if (largest == nullptr || magnitude > std::abs(largest->values[row])) {
        largest = &line;
        row = i;
      }
    }
  }
  if (largest == nullptr) return "Nothing to draw: every value is zero or not finite.";
  const std::string x = number(plot.x[row], 4);
  return unbroken(fmt::format("Largest: {} = {} at {}.", largest->label,
                              quantity(largest->values[row], largest->unit == "1" ? "" : largest->unit, 4),
                              plot.over_time ? "t = " + x + " s" : plot.x_label + " = " + x));
}

}  // namespace ursula::report
