// The load over time goes through its rows, is twice continuously differentiable, and stays between neighbouring rows.

#include "model/load.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "base/real50.h"
#include "tests/model/refusals.h"

namespace ursula {
namespace {

using testing::FieldsAre;

TimedWrench row(double time, const Vector3d& force, const Vector3d& moment) { return {time, {force, moment}}; }

std::vector<TimedWrench> fourRows() {
  return {row(0.5, {1, 0, 100}, {0, 0, 5}), row(1.0, {3, 0, 50}, {1, 0, 4}), row(1.2, {3.5, 0, 20}, {0, 0, 4}),
          row(3.0, {4, 0, 90}, {0, 0, 7})};
}

TEST(Load, withoutAHistoryIsConstant) {
  Load load;
  load.force = {1, 2, 3};
  load.moment = {4, 5, 6};
  for (const double t : {-1.0, 0.0, 7.5}) {
    EXPECT_EQ(load.at(t).force, Vector3d(1, 2, 3));
    EXPECT_EQ(load.at(t).moment, Vector3d(4, 5, 6));
    EXPECT_EQ(load.at(Real50(t)).moment, Vector3d(4, 5, 6).cast<Real50>());
  }
  EXPECT_EQ(Load().at(1.0).force, Vector3d(0, 0, 0));
}

TEST(Load, withAHistoryFollowsItAlone) {
  Load load;
  load.force = {9, 9, 9};
  load.history = std::make_shared<LoadHistory>(fourRows());
  EXPECT_EQ(load.at(1.0).force, Vector3d(3, 0, 50));
  EXPECT_EQ(load.at(Real50(1.0)).moment, Vector3<Real50>(1, 0, 4));
}

TEST(LoadHistory, passesThroughItsRowsAndIsConstantBeyond) {
  const LoadHistory history(fourRows());
  for (const TimedWrench& row : fourRows()) {
    EXPECT_LE((history.at(Real50(row.time)).force - row.wrench.force.cast<Real50>()).norm(), Real50("1e-46"));
    EXPECT_LE((history.at(Real50(row.time)).moment - row.wrench.moment.cast<Real50>()).norm(), Real50("1e-46"));
  }
  EXPECT_EQ(history.at(-10.0).force, Vector3d(1, 0, 100));
  EXPECT_EQ(history.at(10.0).moment, Vector3d(0, 0, 7));
  EXPECT_EQ(history.at(Real50(10)).force, Vector3<Real50>(4, 0, 90));
}

TEST(LoadHistory, inDoubleIsTheExactOneRounded) {
  const LoadHistory history(fourRows());
  for (double t = 0.4; t < 3.2; t += 0.013) {
    const Vector3<Real50> off = history.at(t).force.cast<Real50>() - history.at(Real50(t)).force;
    EXPECT_LE(off.norm().convert_to<double>(), 16 * 100 * std::numeric_limits<double>::epsilon());
  }
}

/// First and second derivatives of all six components by one-sided differences of step h.
struct OneSided {
  Vector6<Real50> first, second;
};

OneSided oneSided(const LoadHistory& history, const Real50& t, const Real50& h) {
  const auto at = [&](int k) {
    const Wrench<Real50> wrench = history.at(Real50(t + k * h));
    return (Vector6<Real50>() << wrench.force, wrench.moment).finished();
  };
  return {(at(1) - at(0)) / h, (at(2) - 2 * at(1) + at(0)) / (h * h)};
}

TEST(LoadHistory, isTwiceContinuouslyDifferentiableAtEveryRowEvenTheEnds) {
  const LoadHistory history(fourRows());
  for (const TimedWrench& row : fourRows()) {
    const Real50 h("1e-15");
    const OneSided right = oneSided(history, Real50(row.time), h),
                   left = oneSided(history, Real50(row.time), Real50(-h));
    // The error is h times the next derivative, which 60 · 100 N / (0.2 s)³ bounds.
    EXPECT_LE((right.first - left.first).norm().convert_to<double>(), 1e-8);
    EXPECT_LE((right.second - left.second).norm().convert_to<double>(), 1e-8);
  }
  EXPECT_GT(oneSided(history, Real50(1.0), Real50("1e-15")).first.norm(), 10);
}

TEST(LoadHistory, neverLeavesTheRangeOfItsNeighbours) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-100, 100), step(0.01, 2);
  std::vector<TimedWrench> rows;
  for (double t = 0; rows.size() < 60; t += step(random)) rows.push_back(row(t, {value(random), t, 1}, {0, 0, 0}));
  const LoadHistory history(rows);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double a = rows[i - 1].wrench.force.x(), b = rows[i].wrench.force.x();
    for (int k = 1; k < 20; ++k) {
      const double t = rows[i - 1].time + k * (rows[i].time - rows[i - 1].time) / 20;
      EXPECT_GE(history.at(t).force.x(), std::min(a, b) - 1e-12);
      EXPECT_LE(history.at(t).force.x(), std::max(a, b) + 1e-12);
      EXPECT_NEAR(history.at(t).force.z(), 1, 1e-15);
    }
  }
  // A ramp stays a ramp away from the ends, where the slope goes to zero.
  const double between = 0.5 * (rows[10].time + rows[11].time);
  EXPECT_NEAR(history.at(between).force.y(), between, 1e-12);
}

TEST(LoadHistory, refusesWhatIsNoHistory) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto fault) {
    std::vector<TimedWrench> rows = fourRows();
    fault(rows);
    return refusedParameter([&] { LoadHistory history(rows); });
  };
  EXPECT_THAT(refused([](auto& r) { r.resize(1); }), FieldsAre("load.table", "1 row", ">= 2"));
  EXPECT_THAT(refused([](auto& r) { r[2].time = 1.0; }), FieldsAre("load.table[3].time", "1", "> 1, the time before"));
  EXPECT_THAT(refused([&](auto& r) { r[0].time = nan; }), FieldsAre("load.table[1].time", "nan", "a finite number"));
  EXPECT_THAT(refused([&](auto& r) { r[1].wrench.force.y() = nan; }),
              FieldsAre("load.table[2].force", "a non-finite entry", "finite numbers"));
  EXPECT_THAT(refused([&](auto& r) { r[3].wrench.moment.z() = nan; }),
              FieldsAre("load.table[4].moment", "a non-finite entry", "finite numbers"));
}

}  // namespace
}  // namespace ursula
