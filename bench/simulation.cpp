// Direct-dynamics simulation of the paper's helix of 3 s under the efforts of the inverse dynamics, by
// Runge–Kutta–Fehlberg 7(8). It must end within 2e-9 m of the commanded pose.

#include "bench/benchmarks.h"
#include "parts/fast/fast_dynamics.h"
#include "parts/simulate/simulate.h"

namespace ursula::bench {
namespace {

constexpr double close_enough = 2e-9;

struct Simulated {
  Simulated() : single(scenario.manipulator()) {}

  Vector6d efforts(double t) const { return single.inverseDynamics(scenario.scenario.trajectory->at(t)); }
  double end() const { return scenario.scenario.trajectory->duration(); }
  /// Adds the counters, or an error if the end is elsewhere.
  void count(benchmark::State& state, const Motion<double>& last, long evaluations) const {
    const double off = (last.p - scenario.scenario.trajectory->at(end()).p).norm();
    if (!(off <= close_enough)) state.SkipWithError("the helix did not come back");
    countPoses(state);  // the tables want the time of the whole run
    state.counters["off_m"] = off;
    state.counters["evaluations"] = static_cast<double>(evaluations);
  }

  const Poses& scenario = helix();
  FastDynamics<double> single;
};

void byRungeKutta(benchmark::State& state) {
  const Simulated helix;
  Simulation run;
  for ([[maybe_unused]] auto unused : state)
    run = simulate(
        helix.scenario.scenario, SimulationEngine::noc, [&](double t) { return helix.efforts(t); }, {0, helix.end()},
        1e-13);
  helix.count(state, run.motions.back(), run.evaluations);
}

}  // namespace

void registerSimulations() {
  benchmark::RegisterBenchmark("simulation/Runge-Kutta", byRungeKutta)->Unit(benchmark::kMillisecond);
}

}  // namespace ursula::bench
