// One pose after the other and batches of them, by every instruction set that the processor has, turn by turn.

#include "nocsolver/batch_dynamics.h"
#include "bench/paper_helix.h"

namespace ursula::bench {
namespace {

/// Poses of a scenario that ships, with their efforts.
struct Poses {
  explicit Poses(const char* name)
      : scenario(readScenario(std::string(URSULA_SCENARIOS "/") + name + ".toml")), fast(*scenario.manipulator) {
    for (int k = 0; k < PaperHelix::count; ++k) {
      motions.push_back(scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / PaperHelix::count));
      efforts.push_back(fast.inverseDynamics(motions.back()));
    }
    found.resize(motions.size());
    faults.resize(motions.size());
  }

  double single(bool inverse) {
    const double start = cpuTime();
    for (int i = 0; i < repeats; ++i)
      for (std::size_t k = 0; k < motions.size(); ++k)
        benchmark::DoNotOptimize(inverse ? fast.inverseDynamics(motions[k])
                                         : fast.directDynamics(motions[k], efforts[k]));
    return (cpuTime() - start) / (repeats * PaperHelix::count);
  }
  double batch(const BatchDynamics& dynamics, bool inverse) {
    const double start = cpuTime();
    for (int i = 0; i < repeats; ++i) {
      inverse ? dynamics.inverseDynamics(motions.data(), motions.size(), found.data(), faults.data())
              : dynamics.directDynamics(motions.data(), efforts.data(), motions.size(), found.data(), faults.data());
      benchmark::ClobberMemory();
    }
    return (cpuTime() - start) / (repeats * PaperHelix::count);
  }
  /// Before anything is timed.
  void requireAgreement(const BatchDynamics& dynamics) {
    dynamics.inverseDynamics(motions.data(), motions.size(), found.data(), faults.data());
    for (std::size_t k = 0; k < motions.size(); ++k)
      if (!((found[k] - efforts[k]).norm() <= 1e-11 * efforts[k].norm())) throw std::runtime_error("a batch disagrees");
  }

  static constexpr int repeats = 16;
  Scenario scenario;
  FastDynamics<double> fast;
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> efforts, found;
  std::vector<PoseFault> faults;
};

void batches(benchmark::State& state, const char* name, InstructionSet set, bool inverse) {
  if (!isSupported(set)) return state.SkipWithError("this processor has no such instructions");
  Poses poses(name);
  const BatchDynamics dynamics(*poses.scenario.manipulator, set);
  poses.requireAgreement(dynamics);
  std::vector<double> single, batch, ratio;
  for ([[maybe_unused]] auto unused : state) {
    single.push_back(poses.single(inverse));
    batch.push_back(poses.batch(dynamics, inverse));
    ratio.push_back(single.back() / batch.back());
  }
  state.counters["single_ns"] = 1e9 * median(single);
  state.counters["batch_ns"] = 1e9 * median(batch);
  state.counters["times"] = median(ratio);
}

#define URSULA_BATCHES(name, scenario)                                                                   \
  BENCHMARK_CAPTURE(batches, name##_inverse_sse2, scenario, InstructionSet::sse2, true)->MinTime(1);     \
  BENCHMARK_CAPTURE(batches, name##_inverse_avx2, scenario, InstructionSet::avx2, true)->MinTime(1);     \
  BENCHMARK_CAPTURE(batches, name##_inverse_avx512, scenario, InstructionSet::avx512, true)->MinTime(1); \
  BENCHMARK_CAPTURE(batches, name##_direct_avx512, scenario, InstructionSet::avx512, false)->MinTime(1)
URSULA_BATCHES(URS, "paper-helix");
URSULA_BATCHES(UPS, "flight-simulator");
URSULA_BATCHES(RUS, "hexa");
URSULA_BATCHES(PUS, "hexaglide");
#undef URSULA_BATCHES

}  // namespace
}  // namespace ursula::bench
