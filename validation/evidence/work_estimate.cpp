#include "validation/evidence/work_estimate.h"

#include <chrono>

#include "engines/simbody/simbody_loop.h"
#include "validation/replay/windows.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Of one evaluation of the closed loop's derivatives, s.
double evaluationSeconds(const Scenario& scenario) {
  using Clock = std::chrono::steady_clock;
  constexpr int evaluations = 50;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  const Motion<double> start = scenario.trajectory->at(0);
  const Vector6d torques = nocSubject(*scenario.manipulator, scenario.load).torques(start);
  loop.place(start);
  const std::vector<double> x = loop.state();
  std::vector<double> rate(x.size());
  const Clock::time_point begun = Clock::now();
  for (int k = 0; k < evaluations; ++k) loop.derivative(0, x.data(), torques, rate.data());
  return std::chrono::duration<double>(Clock::now() - begun).count() / evaluations;
}

}  // namespace

double workSeconds(const Scenario& scenario) {
  // What each costs, in evaluations: of a step all replays of it, of a sample all formulations, of an interval its
  // growth.
  constexpr double of_step = 150, of_sample = 150, of_interval = 10;
  const double duration = scenario.trajectory->duration();
  const double steps = plannedStepRate(duration) * duration;
  return evaluationSeconds(scenario) *
         (of_step * steps + of_sample * scenario.simulation.samples + of_interval * linearisedIntervals(duration));
}

}  // namespace ursula
