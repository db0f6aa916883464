// Simulators that are no part of this program: accelerations under efforts, right and wrong ones.

#include "validation/outside/outside_simulator.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "simbody/simbody_loop.h"
#include "tests/support/changed.h"
#include "tests/support/matchers.h"
#include "tests/support/vectors.h"
#include "tests/validation/checks.h"
#include "validation/outside/needed_efforts.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using Accelerations = std::function<Vector6d(const Motion<double>&, const Vector6d&)>;

OutsideSimulator simulatorOf(const Accelerations& one, long* asked = nullptr) {
  return {"outside", [one, asked](const std::vector<Motion<double>>& states, const std::vector<Vector6d>& efforts) {
            std::vector<Vector6d> out;
            for (std::size_t k = 0; k < states.size(); ++k) {
              EXPECT_EQ(states[k].p_ddot.norm() + states[k].omega_dot.norm(), 0) << "the answer is given away";
              out.push_back(one(states[k], efforts[k]));
            }
            if (asked != nullptr) *asked += static_cast<long>(states.size());
            return out;
          }};
}

Accelerations nocOf(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load).accelerations; }

class Simulators : public testing::TestWithParam<const char*> {
 protected:
  Simulators() : scenario_(vectorScenario(GetParam())) { scenario_.simulation.samples = 31; }
  ValidationResult judged(const Accelerations& one) { return validateSimulator(scenario_, simulatorOf(one, &asked_)); }

  Scenario scenario_;
  long asked_ = 0;
};

TEST_P(Simulators, rightOnesPass) {
  const auto loop = std::make_shared<SimbodyLoop>(*scenario_.manipulator, SimbodyLoop::Topology::ball_per_leg);
  const Accelerations simbody = [loop](const Motion<double>& state, const Vector6d& efforts) {
    loop->place(state);
    loop->accelerate(efforts);
    const Motion<double> found = loop->platform();
    return Vector6d((Vector6d() << found.omega_dot, found.p_ddot).finished());
  };
  for (const Accelerations& right : {nocOf(scenario_), simbody}) {
    asked_ = 0;
    const ValidationResult result = judged(right);
    EXPECT_EQ(result.verdict, Verdict::pass);
    for (const char* name : {"direct.pointwise", "direct.off_path", "torque.pointwise", "torque.against_noc"})
      EXPECT_EQ(findCheck(result.checks, name)->verdict, Verdict::pass) << name;
    EXPECT_EQ(findCheck(result.checks, "replay.position")->verdict, Verdict::not_applicable);
    EXPECT_LE(asked_, 2000);
    EXPECT_FALSE(result.cause);
  }
}

TEST_P(Simulators, aMassOffByATenThousandthIsNamed) {
  const Scenario other = changed(scenario_, [](ManipulatorParameters& machine) { machine.platform.mass *= 1.0001; });
  const ValidationResult result = judged(nocOf(other));
  EXPECT_EQ(result.verdict, Verdict::fail);
  EXPECT_LE(asked_, 2000);
  ASSERT_TRUE(result.cause);
  EXPECT_EQ(result.cause->kind, CauseKind::parameter);
  EXPECT_EQ(result.cause->parameter, "manipulator.platform.mass");
}

TEST_P(Simulators, gravityLeftOutIsNamed) {
  const Scenario other = changed(scenario_, [](ManipulatorParameters& machine) { machine.gravity.setZero(); });
  const ValidationResult result = judged(nocOf(other));
  EXPECT_EQ(result.verdict, Verdict::fail);
  ASSERT_TRUE(result.cause);
  EXPECT_EQ(result.cause->kind, CauseKind::missing_term);
  EXPECT_EQ(result.cause->term, "gravity");
}

TEST_P(Simulators, termsOfVelocitiesEffortsInAnotherOrderAndUnusedOnesFail) {
  const Accelerations right = nocOf(scenario_);
  const ValidationResult order = judged([&](const Motion<double>& state, const Vector6d& efforts) {
    Vector6d other = efforts;
    std::swap(other(1), other(4));
    return right(state, other);
  });
  EXPECT_EQ(order.verdict, Verdict::fail);
  ASSERT_TRUE(order.cause);
  EXPECT_EQ(order.cause->kind, CauseKind::order);
  const ValidationResult still = judged([&](Motion<double> state, const Vector6d& efforts) {
    state.p_dot.setZero();
    state.omega.setZero();
    return right(state, efforts);
  });
  EXPECT_EQ(still.verdict, Verdict::fail);
}

TEST_P(Simulators, accelerationsThatDoNotFollowTheEffortsHaveNoOtherCause) {
  const Accelerations right = nocOf(scenario_);
  const Vector6d never = Vector6d::Zero(), constant = Vector6d::LinSpaced(1, 6);
  const auto causeOf = [&](const Accelerations& one) {
    const ValidationResult result = judged(one);
    EXPECT_EQ(result.verdict, Verdict::fail);
    EXPECT_TRUE(!result.cause && result.causes.empty() && result.causes_together.empty()) << result.cause_words.cause;
    EXPECT_LE(asked_, 2000);
    asked_ = 0;
    return result.cause_words.cause;
  };
  EXPECT_EQ(causeOf([&](const auto&, const auto&) { return never; }).find("the same answer whatever is asked: 0 for "),
            0U);
  EXPECT_THAT(causeOf([&](const auto&, const auto&) { return constant; }), testing::HasSubstr("6 for a_z"));
  EXPECT_THAT(causeOf([&](const auto& state, const auto&) { return right(state, never); }),
              testing::ContainsRegex("^the same accelerations whatever the (efforts|torques|forces) are: alpha_x"));
  EXPECT_EQ(causeOf([&](const auto& state, const auto& efforts) {
              Vector6d out = right(state, efforts);
              out(5) = 0.5;
              return out;
            }),
            "the same answer whatever is asked: 0.5 for a_z");
}

INSTANTIATE_TEST_SUITE_P(Machines, Simulators, testing::Values("paper-helix", "random-2", "kind-ups-1"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Simulator, ofAToleranceIsJudgedByItsEfforts) {
  Scenario scenario = vectorScenario("random-2");
  scenario.simulation.samples = 31;
  const Scenario other = changed(scenario, [](ManipulatorParameters& machine) { machine.platform.mass *= 1.0001; });
  scenario.tolerance = EffortTolerance{0.01, 0};
  const ValidationResult wide = validateSimulator(scenario, simulatorOf(nocOf(other)));
  EXPECT_EQ(wide.verdict, Verdict::pass);
  EXPECT_EQ(wide.limits, LimitBy::user);
  scenario.tolerance = EffortTolerance{1e-7, 0};
  EXPECT_EQ(validateSimulator(scenario, simulatorOf(nocOf(other))).verdict, Verdict::fail);
}

TEST(Simulator, whatItThrowsArrives) {
  const Scenario scenario = vectorScenario("random-2");
  int calls = 0;
  const OutsideSimulator broken = {"outside", [&](const auto&, const auto&) -> std::vector<Vector6d> {
                                     ++calls;
                                     throw std::runtime_error("mine");
                                   }};
  EXPECT_THAT([&] { validateSimulator(scenario, broken); }, testing::ThrowsMessage<std::runtime_error>("mine"));
  EXPECT_EQ(calls, 1);
}

/// Affine accelerations with another mobility and another order: the search ends within 2n + 1 questions.
TEST(NeededEfforts, areFoundForWhateverIsAffine) {
  WantedState state;
  state.wanted = Eigen::VectorXd::LinSpaced(3, 1, 3);
  state.efforts = Eigen::VectorXd::LinSpaced(3, -1, 1);
  state.inertia = Eigen::MatrixXd::Identity(3, 3);
  state.scale = Eigen::VectorXd::Ones(3);
  state.rounding = 1e-12;
  Eigen::MatrixXd mobility(3, 3);
  mobility << 0, 2, 0.1, 0, 0.1, -1, 3, 0, 0;
  const Eigen::VectorXd bias = Eigen::VectorXd::LinSpaced(3, 5, 7);
  long asked = 0;
  Unmoved unmoved({"x", "y", "z"});
  const AccelerationsIn simulator = [&](const auto& states, const auto& efforts) {
    asked += static_cast<long>(states.size());
    return std::vector<Eigen::VectorXd>{mobility * efforts.front() + bias};
  };
  const Eigen::VectorXd found = neededEfforts({state}, simulator, 100, unmoved).front();
  EXPECT_LT((mobility * found + bias - state.wanted).norm(), 1e-10);
  EXPECT_LE(asked, 8);
  EXPECT_GT((neededEfforts({state}, simulator, 1, unmoved).front() - found).norm(), 1e-3) << "one question is too few";
  EXPECT_EQ(unmoved.words(), "");
}

}  // namespace
}  // namespace ursula
