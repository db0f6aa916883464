#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/manipulator.h"
#include "report/plots.h"

namespace ursula::report {

/// Returns the rows with finite x in ascending order, as charts require.
std::vector<std::size_t> ascending(const std::vector<double>& x);

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows);

/// Builds charts over time from the columns of one series.
class TimePlots {
 public:
  TimePlots(const TimeSeries& series, std::vector<Plot>& plots);

  const TimeSeries& series() const { return series_; }
  bool empty() const { return rows_.empty(); }
  std::size_t rows() const { return rows_.size(); }

  /// Returns a chart without lines.
  Plot plot(PlotGroup group, const std::string& title, const std::string& y_label, bool log_y = false) const;
  /// Adds a column times `factor`, if it exists.
  void addColumn(Plot& plot, const std::string& column, Line line, double factor = 1) const;
  void addValues(Plot& plot, const std::vector<double>& values, Line line) const;
  /// Adds every leg's column of this quantity.
  void addIndexed(Plot& plot, const std::string& quantity, const std::string& symbol, bool ghost = false) const;
  /// Adds the chart to the list if it has lines.
  void keep(Plot plot);

 private:
  const TimeSeries& series_;
  std::vector<Plot>& plots_;
  std::vector<std::size_t> rows_;
  std::vector<double> t_;
};

/// The validated machine's motors; otherwise the paper's.
Motors motorsOf(const ValidationResult& result);

/// Adds the charts of the time series. Its efforts are those of `motors`; `allowed` is a user's tolerance in their
/// unit, 0 if there is none.
void addSeriesPlots(const TimeSeries& series, const Motors& motors, double allowed, std::vector<Plot>& plots);

/// "₁" for "1".
std::string subscript(const std::string& index);

}  // namespace ursula::report
