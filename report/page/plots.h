#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/manipulator.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// Styles of a line. A ghost is broad and pale under a line of the same colour; a limit is dashed and has its own
/// colour. Points have no line, and all of them are drawn.
enum class Stroke { line, ghost, limit, points };

/// One line of a chart. `color` counts from 0.
struct Line {
  std::string label;
  std::string unit;
  int color = 0;
  Stroke stroke = Stroke::line;
  std::vector<double> values;
};

/// Groups of charts that answer one question.
enum class PlotGroup { worst, sources, errors, efforts, motion, reactions, numerics, relations };

struct Plot {
  std::string title;
  PlotGroup group = PlotGroup::errors;
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  bool over_time = false;  ///< plots over time share their cursor
  bool tube = false;       ///< the first two lines are its upper and lower bound
  std::string words;       ///< its caption; if empty, the largest magnitude and where
  std::size_t rows = 0;    ///< rows of the data; after thinning `x` has fewer
  std::vector<double> x;   ///< ascending and finite
  std::vector<Line> lines;
};

/// Returns the report's charts with data: from the time series, then from the curves.
std::vector<Plot> plots(const ValidationResult& result);

/// Keeps the largest and least values in each of `buckets` equal parts, if there are more than twice as many rows.
Plot thinned(const Plot& plot, std::size_t buckets);

/// Whether `line` has a drawable point: finite, and positive on a logarithmic axis.
bool isDrawable(const Plot& plot, const Line& line);

/// Describes a chart in a sentence for its caption: its own words, or the largest magnitude and where.
std::string inWords(const Plot& plot);

/// A column named `quantity_1_unit`: its index "1", "2", … and its unit, as in columns.
struct Indexed {
  std::string index, unit;
  const std::vector<double>* values = nullptr;
};
std::vector<Indexed> indexed(const TimeSeries& series, const std::string& quantity);

/// Returns a chart's caption and a place for the script's drawing. `index` is the chart's index in the page's data.
std::string figureHtml(const Plot& plot, std::size_t index, const char* heading);

/// Returns the figures of groups side by side; "" if there is none.
std::string figuresHtml(const std::vector<Plot>& plots, const std::vector<PlotGroup>& groups,
                        const char* heading = "h3");

/// Returns the replay's position error, m: the largest in each of a few equal parts of the rows, NaN for parts without
/// one. Empty without a replay.
std::vector<double> trendOf(const TimeSeries& series);

/// Returns a trend as a line over decades, as large as a word; "" if there is nothing to draw.
std::string sparkline(const std::vector<double>& trend);

/// Returns the rows with finite x in ascending order, as charts require.
std::vector<std::size_t> ascending(const std::vector<double>& x);

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows);

/// Builds charts over time from the columns of one series.
class TimePlots {
 public:
  /// `names` are the motors' in the order of efforts; without them they have numbers.
  TimePlots(const TimeSeries& series, std::vector<Plot>& plots, std::vector<std::string> names = {});

  const TimeSeries& series() const { return series_; }
  bool empty() const { return rows_.empty(); }
  std::size_t rows() const { return rows_.size(); }

  /// Returns a chart without lines.
  Plot plot(PlotGroup group, const std::string& title, const std::string& y_label, bool log_y = false) const;
  /// Adds a column times `factor`, if it exists.
  void addColumn(Plot& plot, const std::string& column, Line line, double factor = 1) const;
  void addValues(Plot& plot, const std::vector<double>& values, Line line) const;
  /// Returns "τ₁" for "1", or the motor's name.
  std::string label(const std::string& symbol, const std::string& index) const;
  /// Returns "Motor 1" for "1", or the motor's name.
  std::string motor(const std::string& index) const;
  /// Adds every leg's or motor's column of this quantity.
  void addIndexed(Plot& plot, const std::string& quantity, const std::string& symbol, bool ghost = false) const;
  /// Adds the chart to the list if it has lines.
  void keep(Plot plot);

 private:
  const TimeSeries& series_;
  std::vector<Plot>& plots_;
  std::vector<std::size_t> rows_;
  std::vector<double> t_;
  std::vector<std::string> names_;
};

/// The validated machine's motors; otherwise the paper's.
Motors motorsOf(const ValidationResult& result);

/// Returns the leg of a motor, both from 0.
int legOf(const ValidationResult& result, int motor);

/// Adds the charts of the time series. Its efforts are those of `motors`; `allowed` is a user's tolerance in their
/// unit, 0 if there is none. `names` are the motors' of a mechanism, `output` that of the body whose path is shown. The
/// charts of motor `worst`, from 0, are a group of their own.
void addSeriesPlots(const TimeSeries& series, const Motors& motors, double allowed, std::vector<Plot>& plots,
                    const std::vector<std::string>& names = {}, const std::string& output = "", int worst = -1);

/// "₁" for "1".
std::string subscript(const std::string& index);

}  // namespace ursula::report
