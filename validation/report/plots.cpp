#include "validation/report/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "validation/report/text.h"

namespace ursula::report {
namespace {

constexpr double decades_for_log = 3;
const char* const time_label = "t (s)";

struct Wanted {
  std::string column, label, unit;
  int color = 0;
  bool ghost = false;
};

// Without a point of x there is no place to draw at; the charts need x ascending.
std::vector<std::size_t> order(const std::vector<double>& x) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(x[i])) rows.push_back(i);
  }
  std::stable_sort(rows.begin(), rows.end(), [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  return rows;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::size_t row : rows) {
    result.push_back(row < values.size() ? values[row] : std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

void addOverTime(const TimeSeries& series, Plot plot, const std::vector<Wanted>& wanted, std::vector<Plot>& plots) {
  const std::vector<double>* t = series.find("t_s");
  if (t == nullptr) return;
  const std::vector<std::size_t> rows = order(*t);
  plot.x_label = time_label;
  plot.over_time = true;
  plot.x = picked(*t, rows);
  for (const Wanted& line : wanted) {
    const std::vector<double>* values = series.find(line.column);
    if (values == nullptr) continue;
    plot.lines.push_back({line.label, line.unit, line.color, line.ghost, picked(*values, rows)});
  }
  if (!plot.lines.empty() && !plot.x.empty()) plots.push_back(std::move(plot));
}

std::vector<Wanted> torqueLines() {
  const char* const subscripts[] = {"₁", "₂", "₃", "₄", "₅", "₆"};
  std::vector<Wanted> lines;
  lines.reserve(6);
  for (int leg = 0; leg < 6; ++leg) {
    lines.push_back({fmt::format("tau_{}_Nm", leg + 1), std::string("τ") + subscripts[leg], "N·m", leg});
  }
  return lines;
}

std::vector<Wanted> positionLines() {
  const char* const axes[] = {"x", "y", "z"};
  std::vector<Wanted> lines;
  for (int i = 0; i < 3; ++i) {
    const std::string axis = axes[i];
    lines.push_back({"p_" + axis + "_m", axis + " commanded", "m", i, true});
    lines.push_back({"sim_p_" + axis + "_m", axis + " simulated", "m", i});
  }
  return lines;
}

/// Zero, where an error starts from, has no place on a logarithmic axis and is left out.
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

Plot curvePlot(const std::string& title, const TimeSeries& curve) {
  Plot plot;
  plot.title = title;
  const std::vector<std::size_t> rows = order(curve.columns.front());
  plot.x_label = curve.names.front();
  plot.x = picked(curve.columns.front(), rows);
  Span x, y;
  x.include(plot.x);
  for (std::size_t i = 1; i < curve.columns.size(); ++i) {
    plot.lines.push_back({curve.names[i], "", static_cast<int>(i) - 1, false, picked(curve.columns[i], rows)});
    y.include(plot.lines.back().values);
  }
  if (plot.lines.size() == 1) plot.y_label = plot.lines.front().label;
  // Time is read evenly; any other x goes with a logarithmic y, so that a power law is a straight line.
  plot.over_time = plot.x_label == "t_s";
  if (plot.over_time) plot.x_label = time_label;
  plot.log_y = y.isWide() || (!plot.over_time && x.isWide() && y.positive);
  plot.log_x = !plot.over_time && x.positive && plot.log_y;
  return plot;
}

}  // namespace

std::vector<Plot> plots(const ValidationResult& result) {
  std::vector<Plot> plots;
  const TimeSeries& series = result.timeseries;
  Plot errors;
  errors.log_y = true;
  Plot replay = errors, closure = errors, torques, position;
  torques.title = "Actuator torques";
  torques.y_label = "torque (N·m)";
  replay.title = "Replay: simulated against commanded pose";
  replay.y_label = "error (m, rad)";
  closure.title = "Closure of the loops";
  closure.y_label = "error (m, m/s)";
  position.title = "Position of P";
  position.y_label = "position (m)";
  addOverTime(series, torques, torqueLines(), plots);
  addOverTime(series, replay, {{"error_p_m", "position", "m", 0}, {"error_q_rad", "orientation", "rad", 1}}, plots);
  addOverTime(series, closure, {{"closure_p_m", "position", "m", 0}, {"closure_v_m_s", "velocity", "m/s", 1}}, plots);
  addOverTime(series, position, positionLines(), plots);
  for (const auto& [title, curve] : result.curves) {
    if (curve.columns.size() > 1 && curve.rows() > 0) plots.push_back(curvePlot(title, curve));
  }
  return plots;
}

bool isDrawable(const Plot& plot, const Line& line) {
  return std::any_of(line.values.begin(), line.values.end(),
                     [&plot](double value) { return std::isfinite(value) && (value > 0 || !plot.log_y); });
}

std::string inWords(const Plot& plot) {
  const Line* largest = nullptr;
  std::size_t row = 0;
  for (const Line& line : plot.lines) {
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
  const std::string unit = largest->unit.empty() ? "" : " " + largest->unit;
  const std::string x = number(plot.x[row], 4);
  return fmt::format("Largest: {} = {}{} at {}.", largest->label, number(largest->values[row], 4), unit,
                     plot.over_time ? "t = " + x + " s" : plot.x_label + " = " + x);
}

}  // namespace ursula::report
