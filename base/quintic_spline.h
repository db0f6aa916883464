#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "base/scalar.h"

namespace ursula {

/// Value and first two derivatives of a curve in R^D at one instant.
template <class S, int D>
struct CurvePoint {
  using Vector = Eigen::Matrix<S, D, 1>;
  S t{0};
  Vector value = Vector::Zero(), rate = Vector::Zero(), acceleration = Vector::Zero();
};

/// The piecewise quintic curve in R^D with the knots' values and first two derivatives; it is twice continuously
/// differentiable. The outermost quintics extend beyond its ends. It needs at least two knots, in order.
template <class S, int D>
class QuinticHermite {
 public:
  using Vector = Eigen::Matrix<S, D, 1>;

  explicit QuinticHermite(const std::vector<CurvePoint<S, D>>& knots) {
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) pieces_.push_back(piece(knots[i], knots[i + 1]));
  }

  /// The same curve, each number rounded once.
  template <class R>
  explicit QuinticHermite(const QuinticHermite<R, D>& other) {
    for (const auto& piece : other.pieces_)
      pieces_.push_back({S(piece.start), S(piece.duration), piece.coefficients.template cast<S>()});
  }

  /// Returns the curve under a linear map of its values, with time divided by `time_unit`.
  QuinticHermite mapped(const Eigen::Matrix<S, D, D>& map, const S& time_unit) const {
    QuinticHermite out(*this);
    for (Piece& piece : out.pieces_) {
      piece.coefficients = (map * piece.coefficients).eval();
      piece.start /= time_unit;
      piece.duration /= time_unit;
    }
    return out;
  }

  /// Returns the same curve with `offset` subtracted from every value.
  QuinticHermite shifted(const Vector& offset) const {
    QuinticHermite out(*this);
    for (Piece& piece : out.pieces_) piece.coefficients.col(0) -= offset;
    return out;
  }

  /// Evaluates powers of s = (t − start) / duration. With control points the second derivative would be a small
  /// difference of large numbers. Does not allocate.
  CurvePoint<S, D> at(const S& t) const {
    const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), t,
                                        [](const S& instant, const Piece& piece) { return instant < piece.start; });
    const Piece& piece = *(after - 1);
    const auto& c = piece.coefficients;
    const S s = (t - piece.start) / piece.duration;
    CurvePoint<S, D> point;
    point.t = t;
    point.value = c.col(5);
    point.rate = 5 * c.col(5);
    point.acceleration = 20 * c.col(5);
    for (int k = 4; k >= 0; --k) {
      point.value = point.value * s + c.col(k);
      if (k >= 1) point.rate = point.rate * s + k * c.col(k);
      if (k >= 2) point.acceleration = point.acceleration * s + k * (k - 1) * c.col(k);
    }
    point.rate /= piece.duration;
    point.acceleration /= piece.duration * piece.duration;
    return point;
  }

 private:
  template <class R, int E>
  friend class QuinticHermite;

  struct Piece {
    S start, duration;
    Eigen::Matrix<S, D, 6> coefficients;  ///< of s⁰ … s⁵
  };

  static Piece piece(const CurvePoint<S, D>& from, const CurvePoint<S, D>& to) {
    const S h = to.t - from.t;
    const Vector rise = to.value - from.value;
    const Vector v_0 = h * from.rate, v_1 = h * to.rate;
    const Vector a_0 = h * h * from.acceleration, a_1 = h * h * to.acceleration;
    Piece piece{from.t, h, {}};
    piece.coefficients.col(0) = from.value;
    piece.coefficients.col(1) = v_0;
    piece.coefficients.col(2) = a_0 / 2;
    piece.coefficients.col(3) = 10 * rise - 6 * v_0 - 4 * v_1 - (3 * a_0 - a_1) / 2;
    piece.coefficients.col(4) = -15 * rise + 8 * v_0 + 7 * v_1 + (3 * a_0 - 2 * a_1) / 2;
    piece.coefficients.col(5) = 6 * rise - 3 * (v_0 + v_1) - (a_0 - a_1) / 2;
    return piece;
  }

  std::vector<Piece> pieces_;
};

/// Sets the first two derivatives at all inner knots so that the curve is four times continuously differentiable.
/// Times, values and the derivatives at both ends are given.
///
/// With h₀, h₁ the durations left and right of a knot and Δ₀, Δ₁ the rises, continuity of the third and fourth
/// derivatives of the quintic Hermite pieces reads
///   S⁗: 168/h₀³ v₋ + 24/h₀² a₋ + 192 (1/h₀³ + 1/h₁³) v + 36 (1/h₁² − 1/h₀²) a + 168/h₁³ v₊ − 24/h₁² a₊
///          = 360 (Δ₀/h₀⁴ + Δ₁/h₁⁴)                                                                              (a)
///   S‴: −24/h₀² v₋ − 3/h₀ a₋ + 36 (1/h₁² − 1/h₀²) v + 9 (1/h₀ + 1/h₁) a + 24/h₁² v₊ − 3/h₁ a₊
///          = 60 (Δ₁/h₁³ − Δ₀/h₀³)                                                                               (b)
/// This is half the gradient of ∫ ‖S‴‖² dt by (v, a). The system is therefore symmetric positive definite, and block
/// elimination needs no pivoting between blocks.
template <class S, int D>
void solveQuinticSpline(std::vector<CurvePoint<S, D>>& knots) {
  using Block = Eigen::Matrix<S, 2, 2>;
  using Rows = Eigen::Matrix<S, 2, D>;
  const auto rows = [](const CurvePoint<S, D>& knot) {
    return (Rows() << knot.rate.transpose(), knot.acceleration.transpose()).finished();
  };
  // After elimination, (v, a) of knot i is constants[i] − factors[i] · (v, a) of knot i + 1.
  std::vector<Rows> constants{rows(knots.front())};
  std::vector<Block> factors{Block::Zero()};
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const S h = knots[i].t - knots[i - 1].t, k = knots[i + 1].t - knots[i].t;
    const Eigen::Matrix<S, 1, D> below = (knots[i].value - knots[i - 1].value).transpose() / (h * h * h);
    const Eigen::Matrix<S, 1, D> above = (knots[i + 1].value - knots[i].value).transpose() / (k * k * k);
    const S cross = 36 * (1 / (k * k) - 1 / (h * h));
    Block left, diagonal, right;
    left << 168 / (h * h * h), 24 / (h * h), -24 / (h * h), -3 / h;
    diagonal << 192 * (1 / (h * h * h) + 1 / (k * k * k)), cross, cross, 9 * (1 / h + 1 / k);
    right << 168 / (k * k * k), -24 / (k * k), 24 / (k * k), -3 / k;
    Rows constant;
    constant.row(0) = 360 * (below / h + above / k);  // (a)
    constant.row(1) = 60 * (above - below);           // (b)
    const Block pivot = (diagonal - left * factors.back()).inverse();
    constants.push_back(pivot * (constant - left * constants.back()));
    factors.push_back(pivot * right);
  }
  for (std::size_t i = knots.size() - 1; i-- > 1;) {
    const Rows solved = constants[i] - factors[i] * rows(knots[i + 1]);
    knots[i].rate = solved.row(0).transpose();
    knots[i].acceleration = solved.row(1).transpose();
  }
}

/// Sets the first two derivatives of `knot` to those of the quintic through the six knots from `first` on.
template <class S, int D>
void differentiateBySix(const std::vector<CurvePoint<S, D>>& knots, std::size_t first, CurvePoint<S, D>& knot) {
  const S scale = knots[first + 5].t - knots[first].t;
  Eigen::Matrix<S, 6, 6> powers;
  Eigen::Matrix<S, 6, D> values;
  for (int i = 0; i < 6; ++i) {
    const CurvePoint<S, D>& other = knots[first + i];
    powers(i, 0) = S(1);
    for (int k = 1; k < 6; ++k) powers(i, k) = powers(i, k - 1) * (other.t - knot.t) / scale;
    values.row(i) = other.value.transpose();
  }
  const Eigen::Matrix<S, 6, D> coefficients = powers.partialPivLu().solve(values);
  knot.rate = coefficients.row(1).transpose() / scale;
  knot.acceleration = 2 * coefficients.row(2).transpose() / (scale * scale);
}

}  // namespace ursula
