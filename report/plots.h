#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// How a line is drawn: a ghost broad and pale under a line of the same colour, a limit dashed and in a colour of its
/// own; points without a line, all of them in the static drawing.
enum class Stroke { line, ghost, limit, points };

/// One line of a chart. `color` counts from 0.
struct Line {
  std::string label;
  std::string unit;
  int color = 0;
  Stroke stroke = Stroke::line;
  std::vector<double> values;
};

/// Charts that answer one question stand together.
enum class PlotGroup { sources, errors, efforts, motion, reactions, numerics };

struct Plot {
  std::string title;
  PlotGroup group = PlotGroup::errors;
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  bool over_time = false;  ///< plots over time share their cursor
  bool tube = false;       ///< the first two lines bound one, from above and from below
  std::size_t rows = 0;    ///< of the data; more than `x` holds where it was thinned for the eye
  std::vector<double> x;   ///< ascending and finite
  std::vector<Line> lines;
};

/// The charts of the report, for which there are columns and rows: from the time series, then from the curves.
std::vector<Plot> plots(const ValidationResult& result);

/// The largest and least values of each of `buckets` equal parts of the rows, where there are more rows than twice
/// that.
Plot thinned(const Plot& plot, std::size_t buckets);

/// Whether `line` has a point to draw: finite, and positive on a logarithmic axis.
bool isDrawable(const Plot& plot, const Line& line);

/// What a chart shows, in a sentence for its caption: the largest magnitude, and where.
std::string inWords(const Plot& plot);

/// "1", "2", … of a column `quantity_1_unit`, in the order of the columns, with the unit as columns write it.
struct Indexed {
  std::string index, unit;
  const std::vector<double>* values = nullptr;
};
std::vector<Indexed> indexed(const TimeSeries& series, const std::string& quantity);

}  // namespace ursula::report
