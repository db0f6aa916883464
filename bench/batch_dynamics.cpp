// Batches of few poses and of many, by every instruction set that the processor has, on one thread and on two.

#include <algorithm>
#include <stdexcept>

#include "bench/benchmarks.h"
#include "parts/fast/threaded_batch.h"

namespace ursula::bench {
namespace {

constexpr std::size_t most = 100000;

/// The helix's poses, repeated.
struct Many {
  explicit Many(std::size_t count) : motions(count), efforts(count), found(count), faults(count) {
    for (std::size_t k = 0; k < count; ++k) {
      motions[k] = helix().motions[k % Poses::count];
      efforts[k] = helix().efforts[k % Poses::count];
    }
  }

  void solve(const BatchDynamics& dynamics, bool inverse, int jobs) {
    const std::size_t count = motions.size();
    inverse
        ? inverseDynamics(dynamics, motions.data(), count, found.data(), faults.data(), nullptr, jobs)
        : directDynamics(dynamics, motions.data(), efforts.data(), count, found.data(), faults.data(), nullptr, jobs);
  }

  void requireAnswers() const {
    if (std::any_of(faults.begin(), faults.end(), [](PoseFault fault) { return fault != PoseFault::none; }))
      throw std::runtime_error("a pose of the helix has no answer");
  }

  std::vector<Motion<double>> motions;
  std::vector<Vector6d> efforts, found;
  std::vector<PoseFault> faults;
};

void growWithSamples(InstructionSet set, bool inverse) {
  const std::string name = std::string("samples/") + (inverse ? "inverse " : "direct ") + nameOf(set);
  benchmark::RegisterBenchmark(name.c_str(),
                               [set, inverse](benchmark::State& state) {
                                 const auto count = static_cast<std::size_t>(state.range(0));
                                 const BatchDynamics dynamics(helix().manipulator(), set);
                                 Many poses(count);
                                 for ([[maybe_unused]] auto unused : state) {
                                   poses.solve(dynamics, inverse, 1);
                                   benchmark::ClobberMemory();
                                 }
                                 poses.requireAnswers();
                                 countPoses(state, static_cast<double>(count));
                               })
      ->RangeMultiplier(10)
      ->Range(1, most);
}

void growWithThreads(bool inverse) {
  const std::string name = std::string("threads/") + (inverse ? "inverse" : "direct");
  benchmark::RegisterBenchmark(name.c_str(),
                               [inverse](benchmark::State& state) {
                                 const BatchDynamics dynamics(helix().manipulator());
                                 Many poses(most);
                                 for ([[maybe_unused]] auto unused : state) {
                                   poses.solve(dynamics, inverse, static_cast<int>(state.range(0)));
                                   benchmark::ClobberMemory();
                                 }
                                 poses.requireAnswers();
                                 countPoses(state, most);
                               })
      ->DenseRange(1, 2)
      ->UseRealTime();
}

}  // namespace

void registerBatches() {
  for (const bool inverse : {true, false}) {
    for (const InstructionSet set : instructionSets()) growWithSamples(set, inverse);
    growWithThreads(inverse);
  }
}

}  // namespace ursula::bench
