#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "parts/identify/measured_log.h"

namespace ursula::identification {

/// Puts rows on a grid of equal steps. Each row counts at its own instant, unless the motion shows that the rows are
/// even and only their stamps are not. Beyond most_log_rows it takes every second row, then every fourth and so on, and
/// the first of them when more would be too coarse.
class LogGrid {
 public:
  using Place = std::function<std::string()>;  ///< names a row in errors

  /// `turning` are the angles among `width` values of a row, which are unwrapped.
  LogGrid(std::size_t width, std::vector<std::size_t> turning) : width_(width), turning_(std::move(turning)) {}

  /// A row with NaN counts as missing. Throws CsvError unless `t` increases, and for a gap that is too long.
  void add(double t, std::vector<double>& row, const Place& place);
  /// Returns the log with all values in `motion`. `first_lacking` names the first NaN. Throws CsvError for too few
  /// rows.
  MeasuredLog finish(const std::string& file, const std::string& first_lacking = "");

 private:
  void settleHead();
  void put(double t, std::vector<double>& row, const Place& place);
  void append(const std::vector<double>& row, double t);
  void takeLastForLate();
  void halve();
  bool isFull() const;
  void note(MeasuredLog& log, bool even, const std::string& first) const;

  std::size_t width_;
  std::vector<std::size_t> turning_;
  std::vector<std::pair<double, std::vector<double>>> head_;  ///< first rows, which tell the step
  std::vector<double> data_, last_;  ///< `data_` has a row's values and its instant; NaN for a missing row
  double step_ = 0, first_t_ = 0, grid_t_ = 0, end_t_ = 0, last_t_ = 0, jitter_ = 0;
  double before_ = 0, last_steps_ = 0;  ///< the grid's instant before the last row, and the steps from it to that row
  std::size_t count_ = 0, rows_ = 0, gaps_ = 0, lacking_ = 0, left_out_ = 0;
  int every_ = 1;
};

}  // namespace ursula::identification
