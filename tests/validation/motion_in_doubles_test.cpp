// A user's trajectory in doubles alone is judged by differences of doubles; an error in it is still found.

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "model/exact_trajectory.h"
#include "tests/validation/checks.h"
#include "tests/validation/scenario_files.h"
#include "validation/checks/judges.h"

namespace ursula {
namespace {

using Change = std::function<void(Motion<double>&)>;

class InDoubles final : public Trajectory {
 public:
  explicit InDoubles(std::shared_ptr<const Trajectory> truth, Change change = nullptr)
      : truth_(std::move(truth)), change_(std::move(change)) {}
  std::string kind() const override { return truth_->kind(); }
  double duration() const override { return truth_->duration(); }
  Motion<double> at(double t) const override {
    Motion<double> motion = truth_->at(t);
    if (change_) change_(motion);
    return motion;
  }
  const std::vector<double>& knots() const override { return truth_->knots(); }

 private:
  std::shared_ptr<const Trajectory> truth_;
  Change change_;
};

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
                         [](const auto& name) { return asTestName(name.param); });

struct WrongMotion {
  const char *name, *caught_by;
  Change change;
};

class WrongMotionInDoubles : public testing::TestWithParam<WrongMotion> {};

TEST_P(WrongMotionInDoubles, failsTheCheckThatIsForIt) {
  for (const char* scenario : {"paper-helix", "waypoints"}) {
    const InDoubles trajectory(scenarioOf(scenario).trajectory, GetParam().change);
    for (const Check& check : judgeTrajectory(trajectory, 1.5, {})) {
      const bool wanted = check.name == GetParam().caught_by;
      EXPECT_EQ(name(check.verdict), std::string(wanted ? "fail" : "pass")) << scenario << " " << check.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    By, WrongMotionInDoubles,
    testing::Values(WrongMotion{"velocity", "motion.twist", [](auto& m) { m.p_dot *= 1 + 1e-7; }},
                    WrongMotion{"omega", "motion.twist", [](auto& m) { m.omega *= 1 + 1e-7; }},
                    WrongMotion{"acceleration", "motion.twist_rate", [](auto& m) { m.p_ddot *= 1 + 1e-5; }},
                    WrongMotion{"alpha", "motion.twist_rate", [](auto& m) { m.omega_dot *= 1 + 1e-5; }},
                    WrongMotion{"Q", "motion.pose", [](auto& m) { m.Q *= 1 + 1e-14; }},
                    WrongMotion{"no_number", "motion.twist", [](auto& m) { m.omega.x() = std::nan(""); }}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

TEST(MotionInDoublesAlone, isNotAskedForFiftyDigits) {
  const InDoubles trajectory(scenarioOf("hold").trajectory);
  EXPECT_THROW(static_cast<const Trajectory&>(trajectory).at(Real50(0)), std::logic_error);
}

}  // namespace
}  // namespace ursula
