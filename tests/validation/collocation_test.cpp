// Direct dynamics by collocation over batches: efforts of the inverse dynamics bring the commanded motion back, wrong
// ones do not; another integrator and other instruction sets arrive at the same place.

#include "validation/simulate/collocation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/scenario.h"
#include "nocsolver/fast/fast_dynamics.h"
#include "validation/simulate/simulate.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

using testing::HasSubstr;

struct Machine {
  explicit Machine(const std::string& name)
      : scenario(readScenario(URSULA_SCENARIOS "/" + name + ".toml")), dynamics(*scenario.manipulator) {}

  EffortsAt efforts(double factor = 1) const {
    return [this, factor](double t) -> Vector6d {
      const Motion<double> motion = scenario.trajectory->at(t);
      return factor * dynamics.inverseDynamics(motion, loadAtP(scenario.load.get(), motion));
    };
  }
  double duration() const { return scenario.trajectory->duration(); }
  CollocatedMotion run(const EffortsAt& under, const std::vector<double>& instants, double tolerance = 1e-9,
                       InstructionSet set = bestInstructionSet()) const {
    const BatchDynamics batch(*scenario.manipulator, set);
    return collocate(batch, scenario.load.get(), scenario.trajectory->at(instants.front()), under, instants, tolerance);
  }
  /// Of P from the commanded place, m.
  double off(const Motion<double>& motion) const { return (motion.p - scenario.trajectory->at(motion.t).p).norm(); }

  Scenario scenario;
  FastDynamics<double> dynamics;
};

TEST(Collocation, theHelixComesBackToTwoNanometres) {
  const Machine helix("paper-helix");
  const CollocatedMotion run = helix.run(helix.efforts(), {0, 1, 2.2, 3});
  ASSERT_EQ(run.gave_up, "");
  ASSERT_EQ(run.motions.size(), 4U);
  for (const Motion<double>& motion : run.motions) EXPECT_LT(helix.off(motion), 2e-9) << motion.t;
  EXPECT_LT((run.motions.back().Q - helix.scenario.trajectory->at(3).Q).norm(), 2e-9);
  EXPECT_LT((run.motions[1].p_ddot - helix.scenario.trajectory->at(1).p_ddot).norm(), 1e-7);
  EXPECT_LT(run.evaluations, 1000);  // by 13 stages of eighth order it takes as many
}

TEST(Collocation, effortsThatAreWrongDoNotBringItBack) {
  const Machine helix("paper-helix");
  const CollocatedMotion run = helix.run(helix.efforts(1 + 1e-7), {0, 3});
  ASSERT_EQ(run.gave_up, "");
  EXPECT_GT(helix.off(run.motions.back()), 1e-7);
}

/// The end, by an integrator that shares the equations' right-hand side in other arithmetic, and nothing else.
TEST(Collocation, arrivesWhereRungeKuttaDoes) {
  for (const char* name : {"paper-helix", "flight-simulator", "load-platform", "viscous-friction", "mixture"}) {
    const Machine machine(name);
    const EffortsAt wrong = machine.efforts(1 + 1e-5);  // off the commanded path
    const double end = machine.duration() / 4;
    const CollocatedMotion run = machine.run(wrong, {0, end / 3, end});
    ASSERT_EQ(run.gave_up, "") << name;
    const Simulation other = simulate(machine.scenario, Engine::noc, wrong, {0, end / 3, end}, 1e-13);
    ASSERT_EQ(other.gave_up, "") << name;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((run.motions[k].p - other.motions[k].p).norm(), 1e-9) << name << ' ' << k;
    EXPECT_GT(machine.off(run.motions.back()), 1e-8) << name;
  }
}

TEST(Collocation, everyInstructionSetArrivesAtTheSamePlace) {
  const Machine helix("paper-helix");
  const Vector3d p = helix.run(helix.efforts(), {0, 3}, 1e-9, InstructionSet::portable).motions.back().p;
  for (InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512})
    if (isSupported(set)) {
      EXPECT_LT((helix.run(helix.efforts(), {0, 3}, 1e-9, set).motions.back().p - p).norm(), 1e-10) << nameOf(set);
    }
}

TEST(Collocation, aTighterToleranceTakesMoreIntervals) {
  const Machine helix("paper-helix");
  EXPECT_GT(helix.run(helix.efforts(), {0, 3}, 1e-13).intervals, helix.run(helix.efforts(), {0, 3}, 1e-5).intervals);
}

/// Pushed with all it has, the platform leaves what the legs reach.
TEST(Collocation, saysWhereAndWhyItEnds) {
  const Machine helix("paper-helix");
  const EffortsAt push = [&](double t) -> Vector6d { return -3 * helix.efforts()(t); };
  const CollocatedMotion run = helix.run(push, {0, 0.01, 3});
  EXPECT_THAT(run.gave_up, HasSubstr("intervals shrink to nothing at t = "));
  EXPECT_EQ(run.motions.size(), 2U);  // what was reached is there
}

}  // namespace
}  // namespace ursula
