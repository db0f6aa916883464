// The spline through samples of torques: its order, and that the bounds of its errors hold and are not too large.

#include "validation/subject/torque_spline.h"
#include "model/instants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/motions.h"
#include "validation/validate.h"

namespace ursula {
namespace {

Vector6d waves(double t) {
  Vector6d out;
  for (int i = 0; i < leg_count; ++i) out(i) = 1000 * std::sin((1 + 0.5 * i) * t + i);
  return out;
}

std::vector<Vector6d> sampled(const std::vector<double>& t) {
  std::vector<Vector6d> out;
  for (double at : t) out.push_back(waves(at));
  return out;
}

/// The largest of `error` over 200 instants of every interval.
template <class F>
std::vector<double> densely(const std::vector<double>& t, F&& error) {
  std::vector<double> out;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    double largest = 0;
    for (int m = 0; m <= 200; ++m) largest = std::max(largest, error(t[k] + (t[k + 1] - t[k]) * m / 200));
    out.push_back(largest);
  }
  return out;
}

std::vector<double> unevenInstants(int count) {
  SeededDraws dice(20);
  std::vector<double> t = equallySpaced(3, count);
  for (std::size_t k = 1; k + 1 < t.size(); ++k) t[k] += dice.between(-0.3, 0.3) * 3 / (count - 1);
  return t;
}

TEST(TorqueSpline, isExactForQuintics) {
  const auto quintic = [](double t) { return Vector6d::Constant(1 + t * (2 + t * (-3 + t * (1 + t * (-2 + t))))); };
  const std::vector<double> t = unevenInstants(12);
  std::vector<Vector6d> values;
  for (double at : t) values.push_back(quintic(at));
  const TorqueSpline spline(t, values);
  double scale = 0;
  for (const Vector6d& value : values) scale = std::max(scale, value.norm());
  for (double error : densely(t, [&](double at) { return (spline(at) - quintic(at)).norm(); }))
    EXPECT_LE(error, 1e4 * std::numeric_limits<double>::epsilon() * scale);
}

TEST(TorqueSpline, itsErrorFallsWithTheSixthPowerOfTheStep) {
  const auto largest = [](int count) {
    const std::vector<double> errors = interpolationErrors(equallySpaced(3, count), waves);
    return *std::max_element(errors.begin(), errors.end());
  };
  const double order = std::log2(largest(41) / largest(81));
  EXPECT_GT(order, 5.5);
  EXPECT_LT(order, 6.5);
}

TEST(TorqueSpline, interpolationErrorsBoundTheRealOnesWithoutExcess) {
  for (const std::vector<double>& t : {equallySpaced(3, 31), unevenInstants(31), equallySpaced(3, 6)}) {
    const TorqueSpline spline(t, sampled(t));
    const std::vector<double> real = densely(t, [&](double at) { return (spline(at) - waves(at)).norm(); });
    const std::vector<double> bound = interpolationErrors(t, waves);
    ASSERT_EQ(bound.size(), real.size());
    for (std::size_t k = 0; k < real.size(); ++k) {
      EXPECT_LE(real[k], bound[k]) << k;
      EXPECT_GE(real[k], bound[k] / 3) << k;
    }
  }
}

TEST(TorqueSpline, carriedErrorsBoundWhateverSignsTheSamplesErrorsHave) {
  SeededDraws dice(21);
  for (const std::vector<double>& t : {equallySpaced(3, 201), unevenInstants(40)}) {
    std::vector<double> norms;
    for (std::size_t k = 0; k < t.size(); ++k) norms.push_back(dice.between(0, 1));
    const std::vector<double> bound = carriedErrors(t, norms);
    double closest = 0;
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Vector6d> errors;
      for (double norm : norms) errors.push_back((dice.between(-1, 1) < 0 ? -norm : norm) * Vector6d::Unit(2));
      const TorqueSpline spline(t, errors);
      const std::vector<double> real = densely(t, [&](double at) { return spline(at).norm(); });
      for (std::size_t k = 0; k < real.size(); ++k) {
        ASSERT_LE(real[k], bound[k]) << k;
        closest = std::max(closest, real[k] / bound[k]);
      }
    }
    EXPECT_GT(closest, 0.4);
  }
}

}  // namespace
}  // namespace ursula
