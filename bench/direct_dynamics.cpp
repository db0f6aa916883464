// Accelerations from torques, (36): the closed forms, and Simbody's realize(Acceleration) on the same loop.

#include "bench/paper_helix.h"

namespace ursula::bench {
namespace {

/// From pose, twist and torques to the platform's accelerations.
void directDynamicsNoc(benchmark::State& state) {
  const PaperHelix helix;
  Workspace<double> work;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(helix.solver.directDynamics(helix.motions[k], helix.torques[k], work));
    k = (k + 1) % PaperHelix::count;
  }
}
BENCHMARK(directDynamicsNoc);

/// One derivative of the state, the integrator's unit of work.
void directDynamicsSimbody(benchmark::State& state) {
  PaperHelix helix;
  std::vector<double> x_dot(helix.states.front().size());
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    helix.loop.derivative(helix.motions[k].t, helix.states[k].data(), helix.torques[k], x_dot.data());
    benchmark::DoNotOptimize(x_dot.data());
    k = (k + 1) % PaperHelix::count;
  }
}
BENCHMARK(directDynamicsSimbody);

void directDynamicsSideBySide(benchmark::State& state) {
  PaperHelix helix;
  Workspace<double> work;
  std::vector<double> x_dot(helix.states.front().size());
  sideBySide(
      state,
      [&](int k) {
        const auto i = std::size_t(k);
        benchmark::DoNotOptimize(helix.solver.directDynamics(helix.motions[i], helix.torques[i], work));
      },
      [&](int k) {
        const auto i = std::size_t(k);
        helix.loop.derivative(helix.motions[i].t, helix.states[i].data(), helix.torques[i], x_dot.data());
        benchmark::DoNotOptimize(x_dot.data());
      });
}
BENCHMARK(directDynamicsSideBySide)->MinTime(2);

}  // namespace
}  // namespace ursula::bench
