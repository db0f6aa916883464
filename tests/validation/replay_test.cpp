// Open-loop replays of the Simbody loop follow the helix under right torques and leave it under wrong ones.

#include "validation/replay/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "tests/support/vectors.h"
#include "tests/validation/replay_errors.h"
#include "validation/checks/judges.h"
#include "validation/limits/amplification.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

class PaperHelixReplay : public testing::Test {
 protected:
  SimbodyLoop::TorqueHistory torques(double factor = 1) const {
    const Subject noc = nocSubject(*scenario_.manipulator, nullptr);
    return [this, noc, factor](double t) { return Vector6d(factor * noc.torques(scenario_.trajectory->at(t))); };
  }
  ReplaySettings settings(double end = 3) const {
    ReplaySettings out;
    out.end = end;
    return out;
  }
  /// The possible distance of two replays at `tolerance`, by the variational equations.
  double bound(double tolerance, const Replay& replay, double t) const {
    const Amplification amplification(scenario_, 300);
    const GrowthWindow window = amplification.window(
        0, [](double) { return 0.0; }, 0, std::numeric_limits<double>::max());
    const double per_step = errorPerStep(tolerance, 2);
    return window.bound(t, per_step * static_cast<double>(replay.steps.size()) / window.end(), per_step);
  }

  Scenario scenario_ = vectorScenario("paper-helix");
};

TEST_F(PaperHelixReplay, staysOnTheHelix) {
  const Replay found = replay(scenario_, torques(), settings());
  double gap = 0, rate = 0;
  for (const ReplayStep& step : found.steps) {
    gap = std::max(gap, step.closure.position);
    rate = std::max(rate, step.closure.velocity);
  }
  std::cout << "position " << maxPositionError(found) << " m, orientation " << maxRotationError(found) << " rad, gap "
            << gap << " m, " << rate << " m/s, " << found.evaluations << " evaluations\n";
  EXPECT_EQ(found.gave_up, "");
  EXPECT_EQ(found.steps.front().t, 0);
  EXPECT_NEAR(found.steps.back().t, 3, 1e-12);
  EXPECT_LE(maxPositionError(found), 1e-9);  // these five are the project's promises
  EXPECT_LE(maxRotationError(found), 1e-9);
  EXPECT_LE(gap, 1e-12);
  EXPECT_LE(found.evaluations, 1600);
  EXPECT_GT(maxPositionError(found), 0);
}

TEST_F(PaperHelixReplay, countsEveryEvaluation) {
  long calls = 0;
  const SimbodyLoop::TorqueHistory right = torques();
  const Replay found = replay(
      scenario_, [&](double t) { return ++calls, right(t); }, settings(0.5));
  EXPECT_EQ(found.evaluations, calls);
}

TEST_F(PaperHelixReplay, isTheSameThroughTheOtherTopology) {
  ReplaySettings other = settings();
  other.topology = SimbodyLoop::Topology::tree_through_leg_1;
  const Replay a = replay(scenario_, torques(), settings()), b = replay(scenario_, torques(), other);
  EXPECT_EQ(b.gave_up, "");
  EXPECT_LE((a.steps.back().position_error - b.steps.back().position_error).norm(), bound(1e-14, a, 3));
  EXPECT_LE(maxPositionError(b), 1e-9);
  EXPECT_LE(maxRotationError(b), 1e-9);
}

TEST_F(PaperHelixReplay, agreesWithSimbodysOwnIntegrator) {
  ReplaySettings merson = settings();
  merson.integrator = Integrator::rk_merson;
  merson.tolerance = 1e-11;
  merson.instants = 4;
  const Replay b = replay(scenario_, torques(), merson), a = replay(scenario_, torques(), settings());
  EXPECT_EQ(b.gave_up, "");
  ASSERT_EQ(b.steps.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const ReplayStep &at = b.steps[k], with = interpolated(a, at.t);
    EXPECT_NEAR(at.t, static_cast<double>(k), 1e-12);
    EXPECT_LE((at.position_error - with.position_error).norm(), bound(1e-11, a, at.t));
    EXPECT_LE((at.rotation_error - with.rotation_error).norm(), bound(1e-11, a, at.t));
  }
  EXPECT_LE(bound(1e-11, a, 3), 1e-3) << "the bound has lost its meaning";
  std::cout << "rk_merson: " << maxPositionError(b) << " m, " << b.evaluations << " evaluations\n";
  EXPECT_LE(maxPositionError(b), 1e-6);
}

TEST_F(PaperHelixReplay, leavesItUnderTorquesThatAreAMillionthTooLarge) {
  const Replay right = replay(scenario_, torques(), settings()),
               wrong = replay(scenario_, torques(1 + 1e-6), settings());
  EXPECT_EQ(wrong.gave_up, "");
  EXPECT_GT(maxPositionError(wrong), 1e4 * maxPositionError(right));
  EXPECT_GT(maxRotationError(wrong), 1e4 * maxRotationError(right));
  for (const ReplayStep& step : wrong.steps) EXPECT_LE(step.closure.position, 1e-12) << "wrong torques keep the loops";
}

TEST_F(PaperHelixReplay, givesUpButReportsWhatItReached) {
  ReplaySettings few = settings();
  few.max_evaluations = 200;
  const Replay found = replay(scenario_, torques(), few);
  EXPECT_NE(found.gave_up.find("more than 200 derivative evaluations"), std::string::npos) << found.gave_up;
  EXPECT_GT(found.steps.size(), 1u);
  EXPECT_LT(found.steps.back().t, 1);
}

TEST_F(PaperHelixReplay, givesUpOnTorquesThatAreNoNumbers) {
  const Replay found = replay(
      scenario_, [](double) { return Vector6d(Vector6d::Constant(std::nan(""))); }, settings());
  EXPECT_NE(found.gave_up, "");
}

TEST_F(PaperHelixReplay, startsAnywhereOnTheMotion) {
  ReplaySettings later = settings();
  later.start = 1.5;
  later.end = 2;
  const Replay found = replay(scenario_, torques(), later);
  EXPECT_EQ(found.steps.front().t, 1.5);
  EXPECT_LE(found.steps.front().position_error.norm(), 8 * std::numeric_limits<double>::epsilon());
  EXPECT_LE(maxPositionError(found), 1e-11);
}

/// Errors that are cubic in t, with their derivatives as rates.
ReplayStep cubic(double t) {
  ReplayStep step;
  step.t = t;
  step.position_error = Vector3d(1 - t + 2 * t * t - 3 * t * t * t, t * t * t, 1);
  step.velocity_error = Vector3d(-1 + 4 * t - 9 * t * t, 3 * t * t, 0);
  step.rotation_error = 2 * step.position_error;
  step.spin_error = 2 * step.velocity_error;
  step.closure = {t, 2 * t};
  step.energy_error = 3 * t;
  return step;
}

TEST(Interpolated, isExactForCubics) {
  Replay replay;
  replay.steps = {cubic(0), cubic(0.7), cubic(1.9)};
  for (double t : {0.0, 0.3, 0.7, 1.0, 1.9}) {
    const ReplayStep found = interpolated(replay, t), expected = cubic(t);
    const double room = 32 * std::numeric_limits<double>::epsilon() * 30;  // terms of up to 30 in 32 operations
    EXPECT_EQ(found.t, t);
    EXPECT_LE((found.position_error - expected.position_error).norm(), room);
    EXPECT_LE((found.rotation_error - expected.rotation_error).norm(), room);
    EXPECT_NEAR(found.closure.position, expected.closure.position, room);
    EXPECT_NEAR(found.closure.velocity, expected.closure.velocity, room);
    EXPECT_NEAR(found.energy_error, expected.energy_error, room);
  }
}

TEST(Interpolated, holdsTheEndsBeyondThem) {
  Replay replay;
  replay.steps = {cubic(0), cubic(1)};
  EXPECT_EQ(interpolated(replay, -1).position_error, cubic(0).position_error);
  EXPECT_EQ(interpolated(replay, 2).position_error, cubic(1).position_error);
}

}  // namespace
}  // namespace ursula
