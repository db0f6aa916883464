#include "base/stamped_rows.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ursula {
namespace {

/// A polynomial of up to this degree goes through the rows up to `reach` steps away. Its rate is right to 1 % up to a
/// tenth of the rows' rate, and a log whose motion is faster than that is too slow.
constexpr int most_degree = 5;
constexpr double reach = 6;
/// Neighbouring sixth differences are correlated, which about doubles the deviation of their sums; three of these
/// count.
constexpr double deviations = 6;

/// Returns weights with which rows at `x` give Σ wantedⱼ cⱼ of the polynomial Σ cⱼ xʲ that fits them best.
Eigen::VectorXd polynomialWeights(const Eigen::VectorXd& x, const Eigen::VectorXd& wanted) {
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(x.size(), wanted.size());
  for (Eigen::Index j = 1; j < wanted.size(); ++j) powers.col(j) = powers.col(j - 1).cwiseProduct(x);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(powers);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
  out.head(wanted.size()) =
      qr.matrixQR().topRows(wanted.size()).triangularView<Eigen::Upper>().transpose().solve(wanted);
  return qr.householderQ() * out;
}

}  // namespace

/// Rows first … end − 1 are near an instant without a long gap between them; so many are before and after it.
struct StampedRows::Window {
  std::size_t first = 0, end = 0, before = 0, after = 0;

  std::size_t size() const { return end - first; }
};

StampedRows::StampedRows(std::vector<double> data, std::size_t width, double step)
    : data_(std::move(data)), width_(width), step_(step) {
  for (std::size_t slot = 0; (slot + 1) * width_ <= data_.size(); ++slot)
    if (!std::isnan(data_[(slot + 1) * width_ - 1])) there_.push_back(slot);
}

/// Instants and the grid have so many roundings.
double StampedRows::rounding() const {
  return 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(at(0)), std::abs(at(there_.size() - 1)));
}

bool StampedRows::areEven() const {
  static constexpr std::array<double, 7> sixth = {1, -6, 15, -20, 15, -6, 1};
  const Eigen::Index channels = row(0).size();
  Eigen::ArrayXd both = Eigen::ArrayXd::Zero(channels), moves = both, values = both;
  double count = 0;
  for (std::size_t n = 1; n + 8 <= there_.size(); ++n) {
    if (there_[n + 7] - there_[n - 1] != 8) continue;
    Eigen::ArrayXd value = Eigen::ArrayXd::Zero(channels);
    double off = 0;
    for (std::size_t j = 0; j < sixth.size(); ++j) {
      value += sixth[j] * row(n + j).transpose().array();
      off += sixth[j] * (at(n + j) - even(n + j)) / step_;
    }
    const Eigen::ArrayXd move = 0.5 * off * (row(n + 4) - row(n + 2)).transpose().array();
    both += value * move;
    moves += move * move;
    values += value * value;
    ++count;
  }
  double sum = 0, weight = 0;  // of the share of their displacement that the rows have
  for (Eigen::Index k = 0; k < channels; ++k) {
    if (!(moves(k) > 0)) continue;
    const double left = std::max(values(k) - both(k) * both(k) / moves(k), 1e-12 * values(k));
    sum += count * both(k) / left;
    weight += count * moves(k) / left;
  }
  return sum / weight + deviations / std::sqrt(weight) < 0.5;
}

void StampedRows::takeAsEven(EvenRows& grid) {
  const auto count = static_cast<double>(there_.size());
  double slots = 0, instants = 0, squares = 0, products = 0;
  for (std::size_t n = 0; n < there_.size(); ++n)
    slots += static_cast<double>(there_[n]) / count, instants += at(n) / count;
  for (std::size_t n = 0; n < there_.size(); ++n) {
    const double slot = static_cast<double>(there_[n]) - slots;
    squares += slot * slot;
    products += slot * (at(n) - instants);
  }
  step_ = products / squares;
  grid.step = step_;
  grid.start = instants - slots * step_;
  for (std::size_t n = 0; n < there_.size(); ++n) data_[(there_[n] + 1) * width_ - 1] = grid.time(there_[n]);
}

StampedRows::Window StampedRows::windowOf(double t, std::size_t near) const {
  const double gap = (static_cast<double>(most_filled_rows) + 1.5) * step_;
  Window out{near, near + 1, 0, 0};
  while (out.first > 0 && t - at(out.first - 1) <= reach * step_ && at(out.first) - at(out.first - 1) < gap)
    --out.first;
  while (out.end < there_.size() && at(out.end) - t <= reach * step_ && at(out.end) - at(out.end - 1) < gap) ++out.end;
  for (std::size_t n = out.first; n < out.end; ++n) ++(at(n) < t ? out.before : out.after);
  return out;
}

/// Returns the values at `t`: those of the row `near` with what the polynomial adds, or those of the polynomial.
Eigen::RowVectorXd StampedRows::moved(double t, std::size_t near, const Window& window, bool covered) const {
  const std::size_t size = window.size(), degree = std::min({std::size_t{most_degree}, (size + 2) / 2, size - 1});
  Eigen::VectorXd x(size), wanted(degree + 1);
  for (std::size_t n = 0; n < size; ++n) x(n) = (at(window.first + n) - t) / (reach * step_);
  for (std::size_t j = 0; j <= degree; ++j)
    wanted(j) = (j == 0 ? 1.0 : 0.0) - (covered ? std::pow(x(near - window.first), j) : 0.0);
  const Eigen::VectorXd weights = polynomialWeights(x, wanted);
  Eigen::RowVectorXd out = row(near);
  for (std::size_t n = 0; n < size; ++n) out += weights(n) * (row(window.first + n) - row(near));
  return out;
}

/// Returns what a straight line between the rows on either side of `t` has there.
Eigen::RowVectorXd StampedRows::straight(double t, std::size_t near) const {
  const std::size_t before = at(near) > t && near > 0 ? near - 1 : near,
                    after = std::min(before + 1, there_.size() - 1);
  const double between = at(after) - at(before), share = between > 0 ? (t - at(before)) / between : 0;
  return row(before) + share * (row(after) - row(before));
}

void StampedRows::moveTo(EvenRows& grid) const {
  const std::size_t rows = data_.size() / width_;
  grid.values.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(width_ - 1));
  grid.missing.assign(rows, false);
  std::size_t near = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = grid.time(k);
    while (near + 1 < there_.size() && std::abs(at(near + 1) - t) <= std::abs(at(near) - t)) ++near;
    auto values = grid.values.row(static_cast<Eigen::Index>(k));
    values = row(near);
    if (std::abs(at(near) - t) <= rounding()) continue;
    const Window window = windowOf(t, near);
    const bool covered = std::abs(at(near) - t) <= 0.5 * step_, inside = window.before > 1 && window.after > 1;
    if (covered || inside) {
      if (window.size() > 1) values = moved(t, near, window, covered);
    } else {
      values = straight(t, near);
    }
    grid.missing[k] = !covered && !inside;
    if (covered || !inside) continue;
    grid.filled.resize(rows, false);
    grid.filled[k] = true;
  }
}

}  // namespace ursula
