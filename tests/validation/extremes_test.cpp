// Machines and motions at the edges of the judged range: right torques pass there, too, and wrong ones fail.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "model/exact_trajectory.h"
#include "model/instants.h"
#include "parts/fast/fast_subject.h"
#include "tests/validation/checks.h"
#include "tests/validation/replay_errors.h"
#include "tests/validation/scenario_files.h"
#include "validation/replay/replay.h"

namespace ursula {
namespace {

class Extremes : public testing::TestWithParam<std::string> {
 protected:
  Scenario scenario_ = scenarioOf(GetParam(), 31);
  std::shared_ptr<const Reference> reference_ = referenceOf(GetParam(), 31);
};

TEST_P(Extremes, exactTorquesPass) {
  ValidationOptions options;
  options.reference = reference_;
  const ValidationResult result = validate(scenario_, options);
  EXPECT_EQ(others(result.checks, Verdict::pass), "");
  EXPECT_EQ(result.verdict, Verdict::pass);
  EXPECT_GT(findCheck(result.checks, "feedback.torque")->value, 0);
}

TEST_P(Extremes, aMillionthTooMuchFails) {
  const Subject subject = scaledTorques(solverOf(scenario_), 1 + 1e-6);
  const ValidationResult result = validate(scenario_, subject, {false, false, false, reference_});
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_EQ(verdictOf(result.checks, "torque.pointwise"), "fail");
  EXPECT_EQ(verdictOf(result.checks, "feedback.torque"), "fail");
}

TEST(Knots, areThoseOfWaypointsWithinAndNoneOfAHelix) {
  const Scenario waypoints = scenarioOf("waypoints"), helix = scenarioOf("paper-helix");
  const std::vector<double>& all = waypoints.trajectory->knots();
  ASSERT_GT(all.size(), 3u);
  EXPECT_EQ(knotsWithin(waypoints, 0, waypoints.trajectory->duration()),
            std::vector<double>(all.begin() + 1, all.end() - 1));
  EXPECT_EQ(knotsWithin(waypoints, all[1], all[3]), std::vector<double>{all[2]});
  EXPECT_TRUE(knotsWithin(helix, 0, 3).empty());
  EXPECT_FALSE(knotsWithin(scenarioOf("load-table"), 0, 3).empty());
}

/// The same motion, which does not name its knots.
class Knotless final : public ExactTrajectory {
 public:
  explicit Knotless(std::shared_ptr<const Trajectory> whole) : whole_(std::move(whole)) {}
  std::string kind() const override { return whole_->kind(); }
  double duration() const override { return whole_->duration(); }
  Motion<double> at(double t) const override { return whole_->at(t); }
  Motion<Real50> at(const Real50& t) const override { return whole_->at(t); }

 private:
  std::shared_ptr<const Trajectory> whole_;
};

Replay exactReplay(const Scenario& scenario) {
  const Subject right = fastSubject(*scenario.manipulator, scenario.load);  // it has the least rounding
  ReplaySettings settings;
  settings.end = scenario.trajectory->duration();
  return replay(
      scenario, [&](double t) { return right.torques(scenario.trajectory->at(t)); }, settings);
}

/// A step across a knot has a far larger error than its estimate; steps that end at the knot do not.
TEST(Knots, keepTheIntegratorsOrder) {
  Scenario scenario = scenarioOf("waypoints");
  const Replay run = exactReplay(scenario);
  EXPECT_EQ(run.gave_up, "");
  for (double knot : knotsWithin(scenario, 0, scenario.trajectory->duration()))
    EXPECT_TRUE(std::any_of(run.steps.begin(), run.steps.end(), [knot](const auto& step) { return step.t == knot; }));
  scenario.trajectory = std::make_shared<const Knotless>(scenario.trajectory);
  const Replay across = exactReplay(scenario);
  EXPECT_GT(maxPositionError(run), 0);
  EXPECT_GT(maxPositionError(across), 10 * maxPositionError(run));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Extremes,
                         testing::Values("light-legs", "light-platform", "millimetres", "near-singular", "helix-0.3s",
                                         "helix-60s"),
                         [](const auto& name) { return asTestName(name.param); });

}  // namespace
}  // namespace ursula
