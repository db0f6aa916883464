#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/scalar.h"
#include "parts/identify/signals.h"

namespace ursula::identification {
namespace {

Eigen::VectorXd sine(Eigen::Index rows, double step, double f) {
  Eigen::VectorXd out(rows);
  for (Eigen::Index i = 0; i < rows; ++i) out(i) = std::sin(2 * pi * f * static_cast<double>(i) * step);
  return out;
}

TEST(Kernel, valueAndRatesOfWhatPassesAreThoseOfTheSignal) {
  const double step = 1e-3, f = 2, w = 2 * pi * f, shift = 0.37e-3;
  const Kernel kernel(20, step, shift);
  const Eigen::VectorXd x = sine(2000, step, f);
  const std::vector<Eigen::Index> center = {1000};
  const double t = 1000 * step + shift;
  EXPECT_NEAR(Kernel::apply(kernel.value, x, center)(0, 0), std::sin(w * t), 5e-6);
  EXPECT_NEAR(Kernel::apply(kernel.rate, x, center)(0, 0) / w, std::cos(w * t), 5e-6);
  EXPECT_NEAR(Kernel::apply(kernel.acceleration, x, center)(0, 0) / (w * w), -std::sin(w * t), 5e-6);
  const Eigen::VectorXd fast = sine(2000, step, 60);
  EXPECT_NEAR(Kernel::apply(kernel.value, fast, center)(0, 0), 0, 1e-4) << "and what is beyond does not pass";
}

TEST(WhiteNoise, isFoundUnderASmoothSignal) {
  std::mt19937 dice(1);
  std::normal_distribution<double> normal(0, 0.01);
  Eigen::VectorXd x = 5 * sine(5000, 1e-3, 3);
  EXPECT_LT(whiteNoise(x), 1e-4);
  for (double& each : x) each += normal(dice);
  EXPECT_NEAR(whiteNoise(x), 0.01, 1e-3);
}

/// The mean over many signals shows a bias that one signal's scatter hides.
TEST(WhiteNoise, isNotTakenForTooSmall) {
  std::mt19937 dice(3);
  std::normal_distribution<double> normal;
  constexpr int signals = 100;
  double squares = 0;
  for (int i = 0; i < signals; ++i) {
    Eigen::VectorXd x(4000);
    for (double& each : x) each = normal(dice);
    squares += std::pow(whiteNoise(x), 2) / signals;
  }
  EXPECT_NEAR(squares, 1, 0.01);
}

TEST(Quantum, isTheStepOfWhatIsRounded) {
  Eigen::VectorXd x = sine(3000, 1e-3, 1);
  EXPECT_EQ(quantum(x), 0);
  for (double& each : x) each = 0.004 * std::round(each / 0.004);
  EXPECT_NEAR(quantum(x), 0.004, 1e-12);
}

TEST(SaturatedRows, areThoseAtAnEndFarLongerThanElsewhere) {
  Eigen::VectorXd x = sine(3000, 1e-3, 1);
  EXPECT_TRUE(saturatedRows(x).empty());
  x = x.cwiseMin(0.8);
  const auto rows = saturatedRows(x);
  ASSERT_FALSE(rows.empty());
  for (const Eigen::Index row : rows) EXPECT_EQ(x(row), 0.8);
}

MeasuredLog periodic(double period, double noise) {
  std::mt19937 dice(2);
  std::normal_distribution<double> normal(0, noise);
  MeasuredLog log;
  log.step = 1e-3;
  const Eigen::Index rows = 4100;
  log.motion.resize(rows, 2);
  log.efforts = Eigen::MatrixXd::Zero(rows, motor_count);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * log.step, w = 2 * pi / period;
    log.motion(i, 0) = std::sin(w * t) + 0.3 * std::cos(2 * w * t) + normal(dice);
    log.motion(i, 1) = 0.1 * std::cos(3 * w * t) + 0.1 * normal(dice);
    for (int k = 0; k < motor_count; ++k) log.efforts(i, k) = std::cos(w * t) + normal(dice);
  }
  log.missing.assign(static_cast<std::size_t>(rows), false);
  return log;
}

TEST(Periods, areAveragedAndGiveTheNoise) {
  MeasuredLog log = periodic(1, 0.01);
  const Periods found = averagePeriods(log);
  ASSERT_EQ(found.count, 4);
  EXPECT_EQ(log.rows(), 1000);
  EXPECT_NEAR(found.noise.efforts(0), 0.005, 5e-4) << "of a mean of four";
  EXPECT_NEAR(found.noise.motion(0), 0.005, 5e-4);
  MeasuredLog once = periodic(3, 0.01);
  EXPECT_EQ(averagePeriods(once).count, 1);
  EXPECT_EQ(once.rows(), 4100);
}

TEST(MotionBandwidth, isWhereTheAccelerationEnds) {
  MeasuredLog log = periodic(1, 1e-4);
  const Bandwidth found = motionBandwidth(log);
  EXPECT_GT(found.most, 2);
  EXPECT_LT(found.most, 6);
  EXPECT_GE(found.end, found.most);
  EXPECT_LT(found.end, 10);
}

/// A gap is filled by a straight line, whose kinks would count as motion.
TEST(MotionBandwidth, isThatOfTheRowsBesideAGap) {
  MeasuredLog log = periodic(1, 1e-4);
  const double whole = motionBandwidth(log).most;
  const auto fillFrom = [&](Eigen::Index first, Eigen::Index end) {
    for (Eigen::Index i = first; i < end; ++i)
      log.motion.row(i) = log.motion.row(first - 1) + (log.motion.row(end) - log.motion.row(first - 1)) *
                                                          static_cast<double>(i - first + 1) /
                                                          static_cast<double>(end - first + 1);
  };
  fillFrom(1500, 1600);
  EXPECT_GT(motionBandwidth(log).most, 2 * whole) << "taken for a motion";
  for (std::size_t i = 1500; i < 1600; ++i) log.missing[i] = true;
  EXPECT_LT(motionBandwidth(log).most, 1.5 * whole);
}

TEST(FourierSeries, endsWithTheLastHarmonicAboveTheNoise) {
  MeasuredLog log = periodic(1, 1e-4);
  const SampleNoise noise = averagePeriods(log).noise;
  const FourierSeries series(log.motion, log.step, noise.motion, 1);
  EXPECT_GE(series.harmonics(), 3);
  EXPECT_LE(series.harmonics(), 5);
  const double t = 0.21, w = 2 * pi;
  const MeasuredState found = series.at(t, series.harmonics());
  EXPECT_NEAR(found.value(0), std::sin(w * t) + 0.3 * std::cos(2 * w * t), 1e-4);
  EXPECT_NEAR(found.rate(0) / w, std::cos(w * t) - 0.6 * std::sin(2 * w * t), 1e-4);
  EXPECT_NEAR(found.acceleration(1) / (9 * w * w), -0.1 * std::cos(3 * w * t), 1e-4);
}

}  // namespace
}  // namespace ursula::identification
