// Direct-dynamics simulation of the paper's helix of 3 s under the efforts of the inverse dynamics: by collocation over
// batches, and by Runge–Kutta–Fehlberg 7(8), both to where it is commanded within 2e-9 m.

#include "bench/paper_helix.h"
#include "nocsolver/batch_dynamics.h"
#include "nocsolver/fast_dynamics.h"
#include "validation/simulate/collocation.h"
#include "validation/simulate/simulate.h"

namespace ursula::bench {
namespace {

constexpr double close_enough = 2e-9;

struct Helix {
  Helix()
      : scenario(readScenario(URSULA_SCENARIOS "/paper-helix.toml")),
        single(*scenario.manipulator),
        batch(*scenario.manipulator) {}

  Vector6d efforts(double t) const { return single.inverseDynamics(scenario.trajectory->at(t)); }
  double end() const { return scenario.trajectory->duration(); }
  /// Counters, or an error where it is not arrived at.
  void count(benchmark::State& state, const Motion<double>& last, long evaluations) const {
    const double off = (last.p - scenario.trajectory->at(end()).p).norm();
    if (!(off <= close_enough)) state.SkipWithError("the helix did not come back");
    state.counters["off_m"] = off;
    state.counters["evaluations"] = static_cast<double>(evaluations);
  }

  Scenario scenario;
  FastDynamics<double> single;
  BatchDynamics batch;
};

void simulationByCollocation(benchmark::State& state) {
  const Helix helix;
  CollocatedMotion run;
  for ([[maybe_unused]] auto unused : state)
    run = collocate(
        helix.batch, nullptr, helix.scenario.trajectory->at(0), [&](double t) { return helix.efforts(t); },
        {0, helix.end()}, close_enough);
  helix.count(state, run.motions.back(), run.evaluations);
}
BENCHMARK(simulationByCollocation)->Unit(benchmark::kMillisecond);

void simulationByRungeKutta(benchmark::State& state) {
  const Helix helix;
  Simulation run;
  for ([[maybe_unused]] auto unused : state)
    run = simulate(
        helix.scenario, Engine::noc, [&](double t) { return helix.efforts(t); }, {0, helix.end()}, 1e-13);
  helix.count(state, run.motions.back(), run.evaluations);
}
BENCHMARK(simulationByRungeKutta)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ursula::bench
