#include "validation/evidence/work_estimate.h"

#include <chrono>

#include "engines/simbody/simbody_loop.h"
#include "validation/replay/windows.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Time of one evaluation of the closed loop's derivatives, s.
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

WorkParts workParts(const Scenario& scenario) {
  constexpr double of_step = 150, of_interval = 10;  // all replays per step; growth per interval
  const double duration = scenario.trajectory->duration(), samples = scenario.simulation.samples;
  const double over_time = of_step * plannedStepRate(duration) * duration + of_interval * linearisedIntervals(duration);
  WorkParts out;
  out.reference = 0.35 * over_time + samples;
  out.samples = 28 * samples;
  out.replays = 0.45 * over_time;
  out.checks = 0.1 * over_time;
  out.sources = 0.1 * over_time + samples;  // including the time series
  return out;
}

double workSeconds(const Scenario& scenario) { return evaluationSeconds(scenario) * workParts(scenario).total(); }

}  // namespace ursula
