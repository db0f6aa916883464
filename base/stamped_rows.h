#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ursula {

/// Gaps of up to this many rows are filled, because links drop single rows often.
constexpr std::size_t most_filled_rows = 3;

/// Rows at equal steps from `start`.
struct EvenRows {
  double start = 0, step = 0;
  Eigen::MatrixXd values;
  std::vector<bool> missing, filled;  ///< `filled` is empty without any

  double time(std::size_t k) const { return start + static_cast<double>(k) * step; }
};

/// Rows with their instants, such as those of a log.
class StampedRows {
 public:
  /// `data` has rows of `width` entries: a row's values and then its instant, or NaN for a missing row. The first is
  /// there. Rows are about `step` s apart.
  StampedRows(std::vector<double> data, std::size_t width, double step);

  /// Returns whether the values show that the rows are even, and only their instants are not. Uneven rows differ from
  /// even ones by rate times displacement, which a smooth motion has not.
  bool areEven() const;
  /// Puts the rows on the line that is nearest to their instants, which sets the grid's start and step.
  void takeAsEven(EvenRows& grid);
  /// Sets values, gaps and filled rows at the grid's instants. A row that is off the grid keeps its noise, and is moved
  /// by a polynomial through its neighbours.
  void moveTo(EvenRows& grid) const;

 private:
  using Row = Eigen::Map<const Eigen::RowVectorXd>;
  struct Window;

  Row row(std::size_t n) const { return {data_.data() + there_[n] * width_, static_cast<Eigen::Index>(width_ - 1)}; }
  double at(std::size_t n) const { return data_[(there_[n] + 1) * width_ - 1]; }
  /// Returns the instant of an even row.
  double even(std::size_t n) const { return at(0) + static_cast<double>(there_[n]) * step_; }
  double rounding() const;
  Window windowOf(double t, std::size_t near) const;
  Eigen::RowVectorXd moved(double t, std::size_t near, const Window& window, bool covered) const;
  Eigen::RowVectorXd straight(double t, std::size_t near) const;

  std::vector<double> data_;
  std::size_t width_;
  double step_;
  std::vector<std::size_t> there_;  ///< the rows that are not missing
};

}  // namespace ursula
