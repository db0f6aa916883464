#pragma once

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

  /// The curve under a linear map of its values, with time divided by `time_unit`.
  QuinticHermite mapped(const Eigen::Matrix<S, D, D>& map, const S& time_unit) const {
    QuinticHermite out(*this);
    for (Piece& piece : out.pieces_) {
      piece.coefficients = (map * piece.coefficients).eval();
      piece.start /= time_unit;
      piece.duration /= time_unit;
    }
    return out;
  }

  /// The same curve with `offset` subtracted from every value.
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

}  // namespace ursula
