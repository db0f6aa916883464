#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "studies/identify/measured_log.h"

namespace ursula::identification {

constexpr std::size_t fewest_rows = 16, most_gap = 100'000;

/// Collects rows of a grid. Beyond most_log_rows it averages neighbours in pairs.
class GridCollector {
 public:
  explicit GridCollector(std::size_t width) : width_(width), sum_(width, 0.0) {}

  void add(const double* row) {
    for (std::size_t k = 0; k < width_; ++k) sum_[k] += row[k];
    if (++in_sum_ < averaged) return;
    for (double& value : sum_) {
      data.push_back(value / averaged);
      value = 0;
    }
    in_sum_ = 0;
    if (data.size() >= most_log_rows * width_) halve();
  }

  std::size_t rows() const { return data.size() / width_; }

  std::vector<double> data;
  int averaged = 1;

 private:
  void halve() {
    const std::size_t pairs = rows() / 2;
    for (std::size_t i = 0; i < pairs; ++i)
      for (std::size_t k = 0; k < width_; ++k)
        data[i * width_ + k] = (data[2 * i * width_ + k] + data[(2 * i + 1) * width_ + k]) / 2;
    data.resize(pairs * width_);
    averaged *= 2;
  }

  std::size_t width_;
  std::vector<double> sum_;
  int in_sum_ = 0;
};

/// Puts rows on a grid of equal steps by their instants.
class LogGrid {
 public:
  LogGrid(std::size_t width, std::vector<std::size_t> turning)
      : collector_(width), width_(width), turning_(std::move(turning)) {}

  /// `place` names the row in errors.
  template <class Place>
  void add(double t, std::vector<double>& row, const Place& place) {
    if (count_ > 0 && !(t > last_t_))
      throw CsvError(fmt::format("{}: error: t = {} s {} {} s of the row before, expected increasing instants", place(),
                                 t, t == last_t_ ? "repeats" : "comes after", last_t_));
    if (count_ < head_size) {
      head_t_.push_back(t);
      head_.push_back(row);
    } else {
      if (count_ == head_size) settleHead();
      put(t, row, place);
    }
    last_t_ = t;
    ++count_;
  }

  MeasuredLog finish(const std::string& file);

 private:
  static constexpr std::size_t head_size = 1000;

  void settleHead() {
    std::vector<double> steps;
    for (std::size_t k = 1; k < head_t_.size(); ++k) steps.push_back(head_t_[k] - head_t_[k - 1]);
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
    step_ = steps[steps.size() / 2];
    first_t_ = grid_t_ = head_t_.front();
    for (std::size_t k = 0; k < head_t_.size(); ++k)
      put(head_t_[k], head_[k], [&] { return fmt::format("t = {} s", head_t_[k]); });
    head_.clear();
  }

  template <class Place>
  void put(double t, std::vector<double>& row, const Place& place) {
    if (rows_ > 0) {
      const double steps = (t - grid_t_) / step_;
      const auto jump = static_cast<std::size_t>(std::clamp(std::round(steps), 1.0, 1e9));
      if (jump > most_gap)
        throw CsvError(fmt::format("{}: error: {:.6g} s after the row before, where rows are {:.6g} s apart", place(),
                                   t - grid_t_, step_));
      if (jump == 1) jitter_ += (steps - 1) * (steps - 1);
      for (std::size_t k = 1; k < jump; ++k) fill(row, static_cast<double>(k) / static_cast<double>(jump));
      gaps_ += jump > 1 ? 1 : 0;
    }
    bool lacks = false;
    for (std::size_t k = 0; k < width_; ++k)
      if (std::isnan(row[k])) lacks = true, row[k] = last_.empty() ? 0 : last_[k];
    for (const std::size_t k : turning_)
      if (!last_.empty() && std::abs(row[k] - last_[k]) > pi)
        row[k] -= 2 * pi * std::round((row[k] - last_[k]) / (2 * pi));
    append(row.data(), lacks);
    lacking_ += lacks ? 1 : 0;
    last_ = row;
    grid_t_ = t;
  }

  void fill(const std::vector<double>& next, double share) {
    std::vector<double> between = last_;
    for (std::size_t k = 0; k < width_; ++k)
      if (!std::isnan(next[k])) between[k] += share * (next[k] - last_[k]);
    append(between.data(), true);
  }

  void append(const double* row, bool missing) {
    collector_.add(row);
    ++rows_;
    missing_.push_back(missing);
  }

  static constexpr double pi = 3.14159265358979323846;
  GridCollector collector_;
  std::size_t width_;
  std::vector<std::size_t> turning_;
  std::vector<double> head_t_;
  std::vector<std::vector<double>> head_;
  std::vector<bool> missing_;
  std::vector<double> last_;
  double step_ = 0, first_t_ = 0, grid_t_ = 0, last_t_ = 0, jitter_ = 0;
  std::size_t count_ = 0, rows_ = 0, gaps_ = 0, lacking_ = 0;
};

}  // namespace ursula::identification
