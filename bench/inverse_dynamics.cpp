// Torques from a commanded motion: the closed forms, and Simbody on the same loop, in one process.

#include "bench/paper_helix.h"

namespace ursula::bench {
namespace {

/// Displacements, rates and accelerations of all joints, (1)–(19).
void inverseKinematics(benchmark::State& state) {
  const PaperHelix helix;
  Workspace<double> work;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    helix.solver.inverseKinematics(helix.motions[k], work);
    benchmark::DoNotOptimize(work);
    k = (k + 1) % PaperHelix::count;
  }
}
BENCHMARK(inverseKinematics);

/// From the pose, twist and twist rate of the platform to six torques.
void inverseDynamicsNoc(benchmark::State& state) {
  const PaperHelix helix;
  Workspace<double> work;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(helix.solver.inverseDynamics(helix.motions[k], work));
    k = (k + 1) % PaperHelix::count;
  }
}
BENCHMARK(inverseDynamicsNoc);

/// From the joint state and its accelerations, which the closed forms have to find first, to six torques.
void inverseDynamicsSimbody(benchmark::State& state) {
  PaperHelix helix;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    helix.loop.place(helix.motions[k], helix.joints[k]);
    benchmark::DoNotOptimize(helix.loop.inverseDynamics());
    k = (k + 1) % PaperHelix::count;
  }
}
BENCHMARK(inverseDynamicsSimbody);

void inverseDynamicsSideBySide(benchmark::State& state) {
  PaperHelix helix;
  Workspace<double> work;
  sideBySide(
      state,
      [&](int k) { benchmark::DoNotOptimize(helix.solver.inverseDynamics(helix.motions[std::size_t(k)], work)); },
      [&](int k) {
        helix.loop.place(helix.motions[std::size_t(k)], helix.joints[std::size_t(k)]);
        benchmark::DoNotOptimize(helix.loop.inverseDynamics());
      });
}
BENCHMARK(inverseDynamicsSideBySide)->MinTime(2);

}  // namespace
}  // namespace ursula::bench
