#include "parts/causes/pursuit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

namespace ursula {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Indices = std::vector<std::size_t>;

/// An explanation leaves at most these multiples of the limits everywhere, and less than chance would. Without one of
/// its mistakes much more is left; none has an effect that is far larger than all.
constexpr double most_beyond = 2, by_chance = 0.1, much_more = 20, far_larger = 30;
/// An effect that is smaller, relative to the efforts, is none; columns that differ less are one.
constexpr double no_effect = 1e-9, one_column = 1e-13, nearly_one = 1e-10;
constexpr std::size_t likely_sets = 80, best_sets = 24;

Mistakes without(const Mistakes& of, std::size_t member) {
  Mistakes out;
  out.x.resize(of.x.size() - 1);
  for (std::size_t i = 0; i < of.which.size(); ++i) {
    if (i == member) continue;
    out.x(static_cast<Index>(out.which.size())) = of.x(static_cast<Index>(i));
    out.which.push_back(of.which[i]);
  }
  return out;
}

/// Keeps those that leave least, each set once.
void keepBest(std::vector<Mistakes>& sets, std::size_t most) {
  std::stable_sort(sets.begin(), sets.end(),
                   [](const Mistakes& a, const Mistakes& b) { return a.unexplained < b.unexplained; });
  std::set<Indices> known;
  std::vector<Mistakes> out;
  for (Mistakes& one : sets) {
    Indices which = one.which;
    std::sort(which.begin(), which.end());
    if (out.size() < most && known.insert(which).second) out.push_back(std::move(one));
  }
  sets = std::move(out);
}

}  // namespace

Pursuit::Pursuit(std::vector<Suspect> suspects, VectorXd right, VectorXd found, VectorXd limit, Index motors,
                 EffortsTogether together)
    : suspects_(std::move(suspects)),
      outputs_(outputMistakes(motors, discrete_)),
      right_(std::move(right)),
      found_(std::move(found)),
      limit_(std::move(limit)),
      together_(std::move(together)) {
  setColumns();
}

/// Columns of suspects with an effect of their own, then of outputs with a number.
void Pursuit::setColumns() {
  std::vector<VectorXd> columns;
  const double least = no_effect * std::max(right_.norm(), found_.norm());
  for (std::size_t place = 0; place < suspects_.size() + outputs_.size(); ++place) {
    if (isOutput(place) && !hasNumber(place)) continue;
    const VectorXd effect = isOutput(place) ? VectorXd(output(place).of(right_, 1) - right_) : suspects_[place].effect;
    if (!effect.allFinite() || !(effect.norm() > (hasNumber(place) ? 0 : least))) continue;
    bool is_new = true;
    for (std::size_t i = 0; i < columns.size() && is_new; ++i) {
      if (hasNumber(places_[i]) != hasNumber(place)) continue;
      const double along = columns[i].dot(effect), a2 = columns[i].squaredNorm(), b2 = effect.squaredNorm();
      is_new = !(along * along > (1 - one_column) * a2 * b2) || (!hasNumber(place) && std::abs(along - a2) > 1e-7 * a2);
    }
    if (!is_new) continue;
    places_.push_back(place);
    columns.push_back(effect);
  }
  columns_.resize(right_.size(), static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) columns_.col(static_cast<Index>(i)) = columns[i];
}

bool Pursuit::hasNumber(std::size_t place) const {
  return isOutput(place) ? output(place).hasNumber() : suspects_[place].has_number;
}

std::optional<VectorXd> Pursuit::efforts(const Mistakes& of, const EffortsTogether& together) const {
  Indices which;
  std::vector<double> x;
  for (std::size_t i = 0; i < of.which.size(); ++i) {
    if (isOutput(of.which[i])) continue;
    which.push_back(of.which[i]);
    x.push_back(of.x(static_cast<Index>(i)));
  }
  std::optional<VectorXd> out = together(which, Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size())));
  for (const bool with_number : {true, false})  // an order comes last
    for (std::size_t i = 0; out && i < of.which.size(); ++i)
      if (isOutput(of.which[i]) && hasNumber(of.which[i]) == with_number)
        out = output(of.which[i]).of(*out, of.x(static_cast<Index>(i)));
  if (out && !out->allFinite()) return std::nullopt;
  return out;
}

VectorXd Pursuit::left(const Mistakes& of) const {
  const std::optional<VectorXd> made = efforts(of, together_);
  return made ? VectorXd(found_ - *made) : VectorXd::Constant(found_.size(), HUGE_VAL);
}

std::vector<Index> Pursuit::numbersOf(const Mistakes& mistakes) const {
  std::vector<Index> out;
  for (std::size_t i = 0; i < mistakes.which.size(); ++i)
    if (hasNumber(mistakes.which[i])) out.push_back(static_cast<Index>(i));
  return out;
}

/// What the efforts change by each of these numbers, by central differences.
MatrixXd Pursuit::slopes(const Mistakes& at, const std::vector<Index>& numbers) const {
  MatrixXd out(right_.size(), static_cast<Index>(numbers.size()));
  for (Index i = 0; i < out.cols(); ++i) {
    Mistakes above = at, below = at;
    const Index number = numbers[static_cast<std::size_t>(i)];
    const double h = step(at.which[static_cast<std::size_t>(number)]);
    above.x(number) += h, below.x(number) -= h;
    out.col(i) = (left(below) - left(above)) / (2 * h);
  }
  return out;
}

NumbersDoubt Pursuit::doubt(const Mistakes& mistakes) const {
  const Index count = mistakes.x.size();
  NumbersDoubt out{VectorXd::Ones(count), VectorXd::Zero(count)};
  const std::vector<Index> numbers = numbersOf(mistakes);
  if (numbers.empty()) return out;
  MatrixXd S = slopes(mistakes, numbers);
  if (!S.allFinite() || !(S.colwise().norm().minCoeff() > 0)) return out;
  S = (S * S.colwise().norm().cwiseInverse().asDiagonal()).eval();
  const VectorXd variances = MatrixXd(S.transpose() * S).inverse().diagonal();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    out.inflation(numbers[i]) = std::sqrt(std::max(1.0, variances(static_cast<Index>(i))));
  Mistakes other = mistakes;  // the same in the other order
  std::reverse(other.which.begin(), other.which.end());
  other.x.reverseInPlace();
  improve(other, 10);
  if (other.beyond <= most_beyond) out.shift = (other.x.reverse() - mistakes.x).cwiseAbs();
  return out;
}

/// Gauss–Newton by differences; sets what is left.
void Pursuit::improve(Mistakes& mistakes, int steps) const {
  const std::vector<Index> numbers = numbersOf(mistakes);
  VectorXd remaining = left(mistakes);
  bool better = !numbers.empty();
  for (int k = 0; k < steps && better && remaining.allFinite(); ++k) {
    const MatrixXd slopes = this->slopes(mistakes, numbers);
    if (!slopes.allFinite()) break;
    const VectorXd sizes = slopes.colwise().norm().cwiseMax(1e-300).transpose();
    const MatrixXd scaled = slopes * sizes.cwiseInverse().asDiagonal();
    VectorXd dx = scaled.colPivHouseholderQr().solve(remaining).cwiseQuotient(sizes);
    better = false;
    for (int halvings = 0; halvings < 4 && !better; ++halvings, dx /= 2) {
      Mistakes there = mistakes;
      for (Index i = 0; i < dx.size(); ++i) there.x(numbers[i]) += dx(i);
      const VectorXd then = left(there);
      better = then.norm() < remaining.norm();
      if (better) mistakes.x = there.x, remaining = then;
    }
  }
  mistakes.numbers = static_cast<int>(numbers.size());
  mistakes.unexplained = remaining.norm() / (found_ - right_).norm();
  mistakes.beyond = (remaining.cwiseAbs().array() / limit_.array()).maxCoeff<Eigen::PropagateNaN>();
}

/// Every mistake as a start of pairs, with its number to first order.
std::vector<Mistakes> Pursuit::singles() const {
  std::vector<Mistakes> out;
  const VectorXd residual = found_ - right_;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto column = columns_.col(static_cast<Index>(i));
    const double x = hasNumber(places_[i]) ? column.dot(residual) / column.squaredNorm() : 0;
    out.push_back({{places_[i]}, VectorXd::Constant(1, x)});
  }
  for (std::size_t i = 0; i < discrete_; ++i) out.push_back({{suspects_.size() + i}, VectorXd::Zero(1)});
  return out;
}

/// An orthonormal basis of what a set's own numbers make of its efforts `base`, to first order.
MatrixXd Pursuit::basisAt(const Mistakes& inner, const VectorXd& base) const {
  MatrixXd slopes = MatrixXd::Zero(right_.size(), std::max<Index>(1, inner.x.size()));
  for (Index k = 0; k < inner.x.size(); ++k) {
    if (!hasNumber(inner.which[static_cast<std::size_t>(k)])) continue;
    Mistakes near = inner;
    near.x(k) += step(inner.which[static_cast<std::size_t>(k)]);
    if (const std::optional<VectorXd> there = efforts(near, together_)) slopes.col(k) = (*there - base).normalized();
  }
  const Eigen::ColPivHouseholderQR<MatrixXd> factors(slopes);
  return factors.householderQ() * MatrixXd::Identity(right_.size(), factors.rank());
}

/// Adds each further mistake by least squares, in which the start's own numbers are fitted again. What was done last is
/// undone first.
void Pursuit::extend(const Mistakes& start, std::vector<Mistakes>& out) const {
  const bool is_last = isOutput(start.which.back()) && !hasNumber(start.which.back());
  const Mistakes inner = is_last ? without(start, start.which.size() - 1) : start;
  const VectorXd target = is_last ? output(start.which.back()).undone(found_) : found_;
  const std::optional<VectorXd> base = inner.which.empty() ? right_ : efforts(inner, together_);
  if (!base) return;
  const MatrixXd Q = basisAt(inner, *base);
  VectorXd residual = target - *base;
  residual -= Q * (Q.transpose() * residual);
  MatrixXd columns = columns_;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (isOutput(places_[i])) columns.col(static_cast<Index>(i)) = output(places_[i]).of(*base, 1) - *base;
  const VectorXd along = columns.transpose() * residual;
  const VectorXd all = columns.colwise().squaredNorm().transpose();
  VectorXd across = all;
  for (Index k = 0; k < Q.cols(); ++k) across -= (columns.transpose() * Q.col(k)).cwiseAbs2();
  const double scale = found_.norm() / std::max(target.norm(), 1e-300);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    if (std::find(start.which.begin(), start.which.end(), places_[i]) != start.which.end()) continue;
    if (hasNumber(places_[i]) && !(across(k) > nearly_one * all(k))) continue;
    const double x = hasNumber(places_[i]) ? along(k) / across(k) : 0;
    const double less = hasNumber(places_[i]) ? x * along(k) : 2 * along(k) - across(k);
    Mistakes more{inner.which, VectorXd::Zero(static_cast<Index>(start.which.size()) + 1)};
    more.which.push_back(places_[i]);
    more.x.head(inner.x.size()) = inner.x;
    more.x(inner.x.size()) = x;
    if (is_last) more.which.push_back(start.which.back());
    more.unexplained = scale * std::sqrt(std::max(0.0, residual.squaredNorm() - less));
    out.push_back(std::move(more));
  }
}

std::vector<Mistakes> Pursuit::extended(const std::vector<Mistakes>& smaller) const {
  std::vector<Mistakes> out;
  for (const Mistakes& start : smaller) {
    extend(start, out);
    if (out.size() > 20 * likely_sets) keepBest(out, likely_sets);
  }
  keepBest(out, likely_sets);
  for (Mistakes& one : out) improve(one, 2);
  keepBest(out, likely_sets);
  for (std::size_t i = 0; i < std::min(out.size(), best_sets); ++i) improve(out[i], 10);
  return out;
}

bool Pursuit::isEachNeeded(const Mistakes& mistakes) const {
  for (std::size_t i = 0; i < mistakes.which.size(); ++i) {
    const std::optional<VectorXd> one = efforts(mistakes.only(i), together_);
    if (!one || !((*one - right_).norm() <= far_larger * (found_ - right_).norm())) return false;
    Mistakes others = without(mistakes, i);
    improve(others, 6);
    if (!(others.beyond > much_more * std::max(1.0, mistakes.beyond))) return false;
  }
  return true;
}

/// Whether both are one mistake, perhaps of other bodies.
bool Pursuit::areAlike(std::size_t i, std::size_t j) const {
  if (i == j || isOutput(i) || isOutput(j)) return i == j;
  const NamedCause &one = suspects_[i].named, &other = suspects_[j].named;
  return one.kind == other.kind && one.term == other.term && one.leg == other.leg && one.motor == other.motor &&
         one.parameter == other.parameter && one.joint == other.joint;
}

std::vector<Mistakes> Pursuit::all() const {
  std::vector<Mistakes> sets = singles(), out;
  for (int count = 2; count <= 3 && out.empty(); ++count) {
    sets = extended(sets);
    std::copy_if(sets.begin(), sets.end(), std::back_inserter(out), [this](const Mistakes& one) {
      return one.beyond <= most_beyond && one.unexplained <= by_chance && isEachNeeded(one);
    });
  }
  std::stable_sort(out.begin(), out.end(), [](const Mistakes& a, const Mistakes& b) { return a.numbers < b.numbers; });
  return out;
}

std::vector<Mistakes> Pursuit::best() const {
  std::vector<Mistakes> out;
  for (const Mistakes& other : all()) {
    if (!out.empty() && other.numbers > out.front().numbers) break;
    const auto like = std::find_if(out.begin(), out.end(), [&](const Mistakes& one) {
      return std::is_permutation(one.which.begin(), one.which.end(), other.which.begin(), other.which.end(),
                                 [this](std::size_t i, std::size_t j) { return areAlike(i, j); });
    });
    if (like == out.end()) {
      out.push_back(other);
      continue;
    }
    for (const std::size_t place : like->which)
      if (std::find(other.which.begin(), other.which.end(), place) == other.which.end())
        like->any_body.push_back(place);
  }
  return out;
}

}  // namespace ursula
