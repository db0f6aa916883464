// Stiff friction and long-held poses: an implicit integrator is used if friction would shorten an explicit one's steps,
// and a held pose costs only its windows.

#include "validation/replay/radau.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/trajectories/trajectories.h"
#include "tests/validation/replay_errors.h"
#include "validation/evidence/reference.h"
#include "validation/limits/amplification.h"
#include "validation/replay/replay.h"
#include "validation/replay/windows.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// coulomb-friction.toml with its friction multiplied.
struct Friction {
  double viscous = 1, coulomb = 1, smoothing_speed = 1;
};

Scenario rubbing(const Friction& times) {
  Scenario out = readScenario(URSULA_SCENARIOS "/coulomb-friction.toml");
  ManipulatorParameters machine = out.manipulator->parameters();
  for (Leg& leg : machine.legs)
    for (double JointFriction::*joint : {&JointFriction::phi, &JointFriction::psi, &JointFriction::theta}) {
      leg.friction.*joint *= times.viscous;
      leg.coulomb.*joint *= times.coulomb;
    }
  for (Leg& leg : machine.legs) {
    leg.coulomb.smoothing_speed *= times.smoothing_speed;
  }
  out.manipulator = std::make_shared<const Manipulator>(machine);
  return out;
}

Replay replayed(const Scenario& scenario, bool stiff, double end, double factor = 1, double tolerance = 1e-12) {
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  ReplaySettings settings;
  settings.stiff = stiff;
  settings.tolerance = tolerance;
  settings.end = end;
  return replay(
      scenario, [&](double t) -> Vector6d { return factor * right.torques(scenario.trajectory->at(t)); }, settings);
}

/// y' = −λ (y − cos t) − sin t, whose solution is cos t for any λ.
RadauStep::Rate decaying(double lambda, long& evaluations) {
  return [lambda, &evaluations](const std::vector<double>& x, std::vector<double>& rate, double t) {
    ++evaluations;
    rate[0] = -lambda * (x[0] - std::cos(t)) - std::sin(t);
  };
}

TEST(Radau, aDecayOfAMillionASecondShortensNoStep) {
  for (const double lambda : {1.0, 1e3, 1e6}) {
    long evaluations = 0;
    const auto rate = decaying(lambda, evaluations);
    RadauStep step;
    std::vector<double> x = {1.0};
    double t = 0, h = 0.1;
    while (t < 5) {
      h = std::min(h, 5 - t);
      const auto error = step.tryStep(rate, x, t, h, {1e-9, 1e-9});  // above rounding amplified by λ
      if (error && *error <= 1) t += h;
      h *= changeOfStep(error);
      if (5 - t < 1e-12) break;
    }
    EXPECT_NEAR(x[0], std::cos(5.0), 1e-9) << lambda;
    EXPECT_LT(evaluations, 1000) << lambda;
  }
}

/// At order 17, twice the step has 2^17 times the error or more; a lower order would show.
TEST(Radau, isOfOrderSeventeen) {
  const auto errorOf = [](double h) {
    RadauStep step;
    std::vector<double> x = {1, 0};
    const auto swing = [](const std::vector<double>& at, std::vector<double>& rate, double) {
      rate[0] = at[1];
      rate[1] = -at[0];
    };
    double t = 0;
    for (int k = 0; k < std::lround(24 / h); ++k, t += h) EXPECT_TRUE(step.tryStep(swing, x, t, h, {1, 1}));
    return std::hypot(x[0] - std::cos(24), x[1] + std::sin(24));
  };
  const double order = std::log(errorOf(6) / errorOf(3)) / std::log(2);
  EXPECT_GT(order, 14);
  EXPECT_LT(order, 19);
}

TEST(Radau, whatIsNoNumberSolvesNothing) {
  const auto nothing = [](const std::vector<double>&, std::vector<double>& rate, double) { rate[0] = std::nan(""); };
  RadauStep step;
  std::vector<double> x = {1};
  const auto error = step.tryStep(nothing, x, 0, 0.1, {1e-9, 1e-9});
  EXPECT_FALSE(error && *error <= 1);
  EXPECT_EQ(x[0], 1);
}

TEST(StiffReplay, arrivesWhereTheExplicitOneDoes) {
  for (const Friction& times : {Friction{}, Friction{1e4, 1, 1}, Friction{1, 100, 1}}) {
    const Scenario scenario = rubbing(times);
    const double off = 1 + 1e-3;  // off the commanded path
    const Replay implicit = replayed(scenario, true, 0.3, off), explicitly = replayed(scenario, false, 0.3, off);
    ASSERT_EQ(implicit.gave_up, "");
    ASSERT_EQ(explicitly.gave_up, "");
    const Vector3d there = implicit.steps.back().position_error;
    EXPECT_LT((there - explicitly.steps.back().position_error).norm(), 1e-10);
    EXPECT_GT(there.norm(), 1e-8);
    EXPECT_LT(implicit.steps.size(), explicitly.steps.size());
  }
}

/// No explicit integrator can follow this friction.
TEST(StiffReplay, followsFrictionThatNoExplicitIntegratorCan) {
  const Scenario scenario = rubbing({1e6, 1, 1});
  const Replay implicit = replayed(scenario, true, 0.5), explicitly = replayed(scenario, false, 0.5);
  EXPECT_TRUE(explicitly.too_long);
  ASSERT_EQ(implicit.gave_up, "");
  EXPECT_LT(implicit.evaluations, 5000);
  EXPECT_LT(maxPositionError(implicit), 1e-12);
}

TEST(Stiffness, isTheFrictions) {
  const auto stiff = [](const Scenario& scenario) {
    return isStiff(linearised(scenario), scenario.trajectory->duration());
  };
  EXPECT_TRUE(stiff(rubbing({1e4, 1, 1})));
  EXPECT_TRUE(stiff(rubbing({1e6, 1, 1})));
  EXPECT_FALSE(stiff(rubbing({})));
  EXPECT_FALSE(stiff(rubbing({100, 1, 1})));
  EXPECT_FALSE(stiff(readScenario(URSULA_SCENARIOS "/paper-helix.toml")));
  EXPECT_FALSE(stiff(readScenario(URSULA_SCENARIOS "/hold.toml")));
}

/// Friction of the cylinders shortens explicit steps fifty times more than the platform's own decay does.
TEST(Stiffness, isFoundWhereAnExplicitReplayTakesTooLong) {
  Scenario scenario = readScenario(URSULA_SCENARIOS "/three-legs.toml");
  ManipulatorParameters machine = scenario.manipulator->parameters();
  for (Leg& leg : machine.legs) leg.friction.d = 20000;
  scenario.manipulator = std::make_shared<const Manipulator>(machine);
  ASSERT_TRUE(replayed(scenario, false, scenario.trajectory->duration()).too_long);
  const Reference reference(scenario);
  EXPECT_FALSE(isStiff(reference.replays().amplification, reference.scenario.trajectory->duration()));
  EXPECT_TRUE(reference.replays().plan.stiff);
  ASSERT_FALSE(reference.replays().windows.empty());
  for (const WindowedReplay& window : reference.replays().windows) EXPECT_EQ(window.replay.gave_up, "");
}

}  // namespace
}  // namespace ursula
