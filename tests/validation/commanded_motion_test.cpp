// The input that all formulations share: shipped scenarios pass, and the proper check sees each error.

#include "validation/checks/judges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/exact_trajectory.h"
#include "model/trajectories/trajectories.h"
#include "parts/random/random_scenario.h"
#include "tests/support/numbers.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"

namespace ursula {
namespace {

class CommandedMotion : public testing::TestWithParam<std::string> {};

/// Roundings never reach a third of a limit, because limits hold for the worst case.
TEST_P(CommandedMotion, isRightWithAMargin) {
  const Scenario scenario = scenarioOf(GetParam());
  const std::vector<Check> checks = judgeCommandedMotion(scenario);
  EXPECT_EQ(others(checks, Verdict::pass), "");
  for (const Check& check : checks) {
    EXPECT_LE(check.value, check.limit / 3) << check.name << ": " << check.why;
    if (check.limit > 0) RecordProperty(check.name, std::to_string(check.value / check.limit));
  }
  for (const char* name : {"motion.pose", "motion.twist", "motion.twist_rate"})
    EXPECT_NE(findCheck(checks, name), nullptr) << name;
  EXPECT_EQ(findCheck(checks, "motion.load") != nullptr, scenario.load != nullptr);
}

INSTANTIATE_TEST_SUITE_P(Shipped, CommandedMotion, testing::ValuesIn(shippedScenarios()), byName);

TEST(CommandedMotionOfRandomMachines, passes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Check> checks = judgeCommandedMotion(randomScenario(seed));
    EXPECT_EQ(others(checks, Verdict::pass), "") << seed;
    for (const Check& check : checks) EXPECT_LE(check.value, check.limit / 3) << seed << " " << check.name;
  }
}

using Fault = std::function<void(Motion<double>&)>;

/// A trajectory whose double motion is falsified.
template <class Base>
class FaultyDoubles : public Base {
 public:
  explicit FaultyDoubles(std::shared_ptr<const Trajectory> truth, Fault fault = nullptr)
      : truth_(std::move(truth)), fault_(std::move(fault)) {}
  std::string kind() const override { return truth_->kind(); }
  double duration() const override { return truth_->duration(); }
  Motion<double> at(double t) const override {
    Motion<double> motion = truth_->at(t);
    if (fault_) fault_(motion);
    return motion;
  }
  const std::vector<double>& knots() const override { return truth_->knots(); }

 protected:
  std::shared_ptr<const Trajectory> truth_;
  Fault fault_;
};

/// The 50-digit motion stays right.
class Faulty final : public FaultyDoubles<ExactTrajectory> {
 public:
  using FaultyDoubles::at;
  using FaultyDoubles::FaultyDoubles;
  Motion<Real50> at(const Real50& t) const override { return truth_->at(t); }
  HiddenTerms hiddenTerms() const override { return truth_->exact()->hiddenTerms(); }
};

/// A user's trajectory in doubles alone, which is judged by differences of doubles.
using InDoubles = FaultyDoubles<Trajectory>;

void expectOnlyOneFails(const std::vector<Check>& checks, const std::string& caught_by) {
  for (const Check& check : checks)
    EXPECT_EQ(name(check.verdict), std::string(check.name == caught_by ? "fail" : "pass"))
        << check.name << ": " << check.why;
}

struct Control {
  const char *name, *scenario, *caught_by;
  Fault fault;
};

class FaultyMotion : public testing::TestWithParam<Control> {};

TEST_P(FaultyMotion, failsTheCheckThatIsForIt) {
  Scenario scenario = scenarioOf(GetParam().scenario);
  scenario.trajectory = std::make_shared<const Faulty>(scenario.trajectory, GetParam().fault);
  expectOnlyOneFails(judgeCommandedMotion(scenario), GetParam().caught_by);
}

INSTANTIATE_TEST_SUITE_P(
    By, FaultyMotion,
    testing::Values(
        Control{"velocity", "paper-helix", "motion.twist", [](auto& m) { m.p_dot *= 1 + 1e-9; }},
        Control{"velocity_by_little", "paper-helix", "motion.twist", [](auto& m) { m.p_dot *= 1 + 1e-12; }},
        Control{"velocity_of_waypoints", "waypoints", "motion.twist", [](auto& m) { m.p_dot.y() *= 1 + 1e-9; }},
        Control{"omega", "samples", "motion.twist", [](auto& m) { m.omega *= 1 + 1e-9; }},
        Control{"omega_in_the_platform", "waypoints", "motion.twist",
                [](auto& m) { m.omega = (m.Q.transpose() * m.omega).eval(); }},
        Control{"alpha", "paper-helix", "motion.twist_rate", [](auto& m) { m.omega_dot *= 1 + 1e-9; }},
        Control{"alpha_of_samples", "samples", "motion.twist_rate", [](auto& m) { m.omega_dot.x() *= 1 + 1e-9; }},
        Control{"acceleration", "waypoints", "motion.twist_rate", [](auto& m) { m.p_ddot *= 1 + 1e-9; }},
        Control{"held_and_moving", "hold", "motion.twist", [](auto& m) { m.p_dot.x() = 1e-30; }},
        Control{"Q_transposed", "waypoints", "motion.pose", [](auto& m) { m.Q.transposeInPlace(); }},
        Control{"Q_left_handed", "hold", "motion.pose", [](auto& m) { m.Q.col(0) *= -1; }},
        Control{"position", "hold", "motion.pose", [](auto& m) { m.p.z() *= 1 + 1e-13; }},
        Control{"position_is_no_number", "hold", "motion.pose", [](auto& m) { m.p.x() = nan; }},
        Control{"Q_is_no_number", "helix-1s", "motion.pose", [](auto& m) { m.Q(1, 2) = nan; }},
        Control{"velocity_is_no_number", "waypoints", "motion.twist",
                [](auto& m) {
                  if (m.t > 1 && m.t < 1.4) m.p_dot.x() = nan;
                }},
        Control{"alpha_is_no_number", "samples", "motion.twist_rate", [](auto& m) { m.omega_dot.z() = nan; }}),
    [](const auto& control) { return std::string(control.param.name); });

/// A user's limit is compared with the largest error, which has its instant and part.
TEST(CommandedMotionsLargest, hasItsInstantAndPart) {
  Scenario scenario = scenarioOf("paper-helix");
  scenario.trajectory =
      std::make_shared<const Faulty>(scenario.trajectory, [](auto& m) { m.p.z() += 1e-10 * m.t * m.t; });
  const Check check = *findCheck(judgeCommandedMotion(scenario), "motion.pose");
  EXPECT_EQ(check.verdict, Verdict::fail);
  EXPECT_GE(check.largest.value, check.value);
  EXPECT_NEAR(check.largest.value, 1e-10 * check.largest.t * check.largest.t, 1e-13);
  EXPECT_GT(check.largest.t, 2.8) << "of 3 s";
  EXPECT_EQ(check.largest.where, "point P");
}

class MotionInDoubles : public testing::TestWithParam<const char*> {};

TEST_P(MotionInDoubles, isRightWithAMargin) {
  const InDoubles trajectory(scenarioOf(GetParam()).trajectory);
  EXPECT_EQ(trajectory.exact(), nullptr);
  const std::vector<Check> checks = judgeTrajectory(trajectory, 1.5, {});
  EXPECT_EQ(checks.size(), 3U);
  for (const Check& check : checks) EXPECT_LE(check.value, check.limit / 3) << check.name << ": " << check.why;
}

INSTANTIATE_TEST_SUITE_P(Shipped, MotionInDoubles,
                         testing::Values("paper-helix", "helix-0.3s", "helix-60s", "waypoints", "samples", "hold"),
                         byName);

TEST(MotionInDoublesAlone, failsTheCheckThatIsForItsFault) {
  const std::pair<const char*, Fault> faults[] = {{"motion.twist", [](auto& m) { m.p_dot *= 1 + 1e-7; }},
                                                  {"motion.twist", [](auto& m) { m.omega *= 1 + 1e-7; }},
                                                  {"motion.twist_rate", [](auto& m) { m.p_ddot *= 1 + 1e-5; }},
                                                  {"motion.twist_rate", [](auto& m) { m.omega_dot *= 1 + 1e-5; }},
                                                  {"motion.pose", [](auto& m) { m.Q *= 1 + 1e-14; }},
                                                  {"motion.twist", [](auto& m) { m.omega.x() = nan; }}};
  for (const auto& [caught_by, fault] : faults)
    for (const char* scenario : {"paper-helix", "waypoints"})
      expectOnlyOneFails(judgeTrajectory(InDoubles(scenarioOf(scenario).trajectory, fault), 1.5, {}), caught_by);
}

TEST(MotionInDoublesAlone, isNotAskedForFiftyDigits) {
  const InDoubles trajectory(scenarioOf("hold").trajectory);
  EXPECT_THROW(static_cast<const Trajectory&>(trajectory).at(Real50(0)), std::logic_error);
}

/// Rounding alone never fails a motion that is steep, slow, far from rest at its ends, or has many turns or uneven
/// waypoints.
TEST(CommandedMotionLimits, holdForMotionsAtTheEdges) {
  HelixParameters helix;
  helix.radius = 0.2, helix.pitch = 1.2, helix.start_angle = -1.5, helix.end_angle = -1, helix.height_phase = 2.2;
  const auto expectPass = [](const Trajectory& trajectory, const std::string& what) {
    const std::vector<Check> checks = judgeTrajectory(trajectory, 1.5, {});
    EXPECT_EQ(others(checks, Verdict::pass), "") << what;
    for (const Check& check : checks) EXPECT_LE(check.value, check.limit / 2) << what << " " << check.name;
  };
  for (const double duration : {1e-6, 0.01, 1e5}) {
    helix.duration = duration;
    expectPass(*makeHelix(helix), "duration " + std::to_string(duration));
    HelixParameters moving = helix;
    moving.start_rate = 3 / duration, moving.end_rate = -2 / duration;
    moving.start_acceleration = 50 / duration / duration, moving.end_acceleration = -9 / duration / duration;
    expectPass(*makeHelix(moving), "moving at both ends, duration " + std::to_string(duration));
    HelixParameters turning = helix;
    turning.end_angle = 20;
    expectPass(*makeHelix(turning), "three turns, duration " + std::to_string(duration));
  }
  std::vector<TimedPose> points;
  double t = 0;
  for (int i = 0; i < 70; ++i) {
    const double angle = 0.1 * std::sin(1.7 * i);
    points.push_back(
        {t, {std::sin(i), std::cos(2 * i), 1}, {std::cos(angle), 0.6 * std::sin(angle), 0, 0.8 * std::sin(angle)}});
    t += i % 7 == 3 ? 0.4 : 0.5 + 0.1 * (i % 3);
  }
  expectPass(*makeWaypoints(points), "uneven waypoints");
}

TEST(CommandedMotionLimits, doNotGrowWithWhatIsOnTrial) {
  const Scenario right = scenarioOf("paper-helix");
  Scenario wrong = right;
  wrong.trajectory = std::make_shared<const Faulty>(right.trajectory, [](auto& m) { m.p_dot *= 1e6; });
  const auto limit = [](const Scenario& s) { return findCheck(judgeCommandedMotion(s), "motion.twist")->limit; };
  EXPECT_LE(limit(wrong), 1e-12);
  EXPECT_GT(limit(right), 0);
}

}  // namespace
}  // namespace ursula
