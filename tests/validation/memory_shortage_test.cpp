// A lack of memory is no finding about the motion: std::bad_alloc passes through.

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <new>

#include "nocsolver/errors.h"
#include "parts/simulate/simulate.h"
#include "tests/model/quick_scenario.h"
#include "validation/replay/replay.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"

namespace ursula {
namespace {

Scenario small() { return parseScenario(quickScenario(), "a.toml"); }

/// A subject that is right for some questions and then throws.
template <class Thrown>
class Ending {
 public:
  Ending(const Scenario& scenario, int asked)
      : right_(nocSubject(*scenario.manipulator, scenario.load)), left_(asked) {}

  Vector6d operator()(const Motion<double>& motion) const {
    if (--*count_ < -left_) throw Thrown();
    return right_.torques(motion);
  }

 private:
  Subject right_;
  int left_;
  std::shared_ptr<std::atomic<int>> count_ = std::make_shared<std::atomic<int>>(0);
};

/// Any other error.
struct Refusal : SingularJacobian {
  Refusal() : SingularJacobian("B is singular, its smallest pivot over its largest", -1, 0, 0, 1e-15, "") {}
};

template <class Thrown>
SimbodyLoop::TorqueHistory history(const Scenario& scenario, int asked) {
  const Ending<Thrown> ending(scenario, asked);
  return [ending, &scenario](double t) { return ending(scenario.trajectory->at(t)); };
}

TEST(MemoryShortage, isNoEndOfAReplay) {
  const Scenario scenario = small();
  for (const Integrator integrator : {Integrator::rkf78, Integrator::rk_merson})
    for (const int asked : {0, 40}) {
      ReplaySettings settings;
      settings.integrator = integrator;
      settings.end = scenario.trajectory->duration();
      EXPECT_THROW(replay(scenario, history<std::bad_alloc>(scenario, asked), settings), std::bad_alloc)
          << name(integrator) << ", " << asked;
      EXPECT_NE(replay(scenario, history<Refusal>(scenario, asked), settings).gave_up, "")
          << name(integrator) << ", the control";
    }
}

TEST(MemoryShortage, isNoEndOfASimulation) {
  const Scenario scenario = small();
  for (const SimulationEngine engine : {SimulationEngine::noc, SimulationEngine::simbody}) {
    EXPECT_THROW(simulate(scenario, engine, history<std::bad_alloc>(scenario, 20), {0, 0.1, 0.2}, 1e-10),
                 std::bad_alloc);
    EXPECT_NE(simulate(scenario, engine, history<Refusal>(scenario, 20), {0, 0.1, 0.2}, 1e-10).gave_up, "");
  }
}

/// It may occur at the samples, between them, or in the replays.
TEST(MemoryShortage, isNoVerdict) {
  const Scenario scenario = small();
  const auto judged = [&scenario](const auto& torques) {
    Subject subject;
    subject.name = "ending";
    subject.torques = torques;
    return validate(scenario, subject);
  };
  for (const int asked : {0, 20, 300})
    EXPECT_THROW(judged(Ending<std::bad_alloc>(scenario, asked)), std::bad_alloc) << asked;
  EXPECT_NE(judged(Ending<Refusal>(scenario, 300)).verdict, Verdict::pass) << "the control: a finding";
  EXPECT_EQ(judged(Ending<Refusal>(scenario, 100000000)).verdict, Verdict::pass) << "the control: it is never thrown";
}

}  // namespace
}  // namespace ursula
