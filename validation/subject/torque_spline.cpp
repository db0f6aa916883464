#include "validation/subject/torque_spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/quintic_spline.h"
#include "base/scalar.h"

namespace ursula {
namespace {

constexpr int point_count = 9;
constexpr double between_points = 2;  // 1/cos(6π/(2·9))

/// The Chebyshev points of (from, to).
std::array<double, point_count> chebyshevPoints(double from, double to) {
  std::array<double, point_count> points{};
  for (int m = 0; m < point_count; ++m)
    points[m] = 0.5 * (from + to) - 0.5 * (to - from) * std::cos((2 * m + 1) * pi / (2 * point_count));
  return points;
}

std::vector<CurvePoint<double, motor_count>> knotsThrough(const std::vector<double>& t,
                                                          const std::vector<Vector6d>& values) {
  std::vector<CurvePoint<double, motor_count>> knots(t.size());
  for (std::size_t k = 0; k < t.size(); ++k) {
    knots[k].t = t[k];
    knots[k].value = values[k];
  }
  differentiateBySix(knots, 0, knots.front());
  differentiateBySix(knots, knots.size() - 6, knots.back());
  solveQuinticSpline(knots);
  return knots;
}

/// For every interval, twice the largest `size` at its points.
template <class F>
std::vector<double> largestBetween(const std::vector<double>& t, F&& size) {
  std::vector<double> out;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    double largest = 0;
    for (double at : chebyshevPoints(t[k], t[k + 1])) {
      const double value = size(at);
      if (!(value <= largest)) largest = value;
      if (std::isnan(largest)) break;
    }
    out.push_back(between_points * largest);
  }
  return out;
}

}  // namespace

TorqueSpline::TorqueSpline(const std::vector<double>& t, const std::vector<Vector6d>& values)
    : curve_(knotsThrough(t, values)) {}

std::vector<double> interpolationErrors(const std::vector<double>& t, const std::function<Vector6d(double)>& exact) {
  std::vector<Vector6d> values;
  values.reserve(t.size());
  for (double at : t) values.push_back(exact(at));
  const TorqueSpline spline(t, values);
  return largestBetween(t, [&](double at) { return (spline(at) - exact(at)).norm(); });
}

/// A cardinal spline falls by at least half per sample, so splines 66 samples apart do not overlap in doubles. One
/// spline holds them all, and its magnitude is the sum of theirs.
std::vector<double> carriedErrors(const std::vector<double>& t, const std::vector<double>& norms) {
  constexpr std::size_t apart = 66;
  std::vector<TorqueSpline> splines;
  for (std::size_t first = 0; first < std::min(apart, t.size()); first += motor_count) {
    std::vector<Vector6d> impulses(t.size(), Vector6d::Zero());
    for (std::size_t k = 0; k < t.size(); ++k)
      if (k % apart >= first && k % apart < first + motor_count)
        impulses[k](static_cast<Eigen::Index>(k % apart - first)) = norms[k];
    splines.emplace_back(t, impulses);
  }
  return largestBetween(t, [&splines](double at) {
    double sum = 0;
    for (const TorqueSpline& spline : splines) sum += spline(at).lpNorm<1>();
    return sum;
  });
}

}  // namespace ursula
