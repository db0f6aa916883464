#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// One line of a chart. `color` counts from 0; `ghost` is drawn broad and pale, under a line of the same colour.
struct Line {
  std::string label;
  std::string unit;
  int color = 0;
  bool ghost = false;
  std::vector<double> values;
};

struct Plot {
  std::string title;
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  bool over_time = false;  ///< plots over time share their cursor
  std::vector<double> x;   ///< ascending and finite
  std::vector<Line> lines;
};

/// The charts of the report: torques, replay errors, closure errors, commanded and simulated position from the time
/// series, then every curve. What has no columns or no rows has no chart.
std::vector<Plot> plots(const ValidationResult& result);

/// Whether `line` has a point to draw: finite, and positive on a logarithmic axis.
bool isDrawable(const Plot& plot, const Line& line);

/// What a chart shows, in a sentence for its caption: range of x, the largest magnitude, and where.
std::string inWords(const Plot& plot);

}  // namespace ursula::report
