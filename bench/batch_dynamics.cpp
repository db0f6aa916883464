// Batches: by every instruction set that the processor has, of few poses and of many, in one thread and in two.

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "bench/benchmarks.h"

namespace ursula::bench {
namespace {

constexpr std::size_t most = 100000;

/// The helix' poses over and over.
struct Many {
  explicit Many(std::size_t count) : motions(count), efforts(count), found(count), faults(count) {
    for (std::size_t k = 0; k < count; ++k) {
      motions[k] = helix().motions[k % Poses::count];
      efforts[k] = helix().efforts[k % Poses::count];
    }
  }

  /// Of the poses from `first` on.
  void solve(const BatchDynamics& dynamics, bool inverse, std::size_t first, std::size_t count) {
    inverse ? dynamics.inverseDynamics(&motions[first], count, &found[first], &faults[first])
            : dynamics.directDynamics(&motions[first], &efforts[first], count, &found[first], &faults[first]);
  }

  void requireAnswers() const {
    if (std::any_of(faults.begin(), faults.end(), [](PoseFault fault) { return fault != PoseFault::none; }))
      throw std::runtime_error("a pose of the helix has no answer");
  }

  std::vector<Motion<double>> motions;
  std::vector<Vector6d> efforts, found;
  std::vector<PoseFault> faults;
};

/// Disjoint parts, one for each thread. The seam for the library's own batch in threads.
void solveInThreads(const BatchDynamics& dynamics, bool inverse, Many& poses, std::size_t threads) {
  const std::size_t count = poses.motions.size(), part = (count + threads - 1) / threads;
  std::vector<std::thread> others;
  for (std::size_t first = part; first < count; first += part)
    others.emplace_back([&, first] { poses.solve(dynamics, inverse, first, std::min(part, count - first)); });
  poses.solve(dynamics, inverse, 0, std::min(part, count));
  for (std::thread& other : others) other.join();
}

void growWithSamples(InstructionSet set, bool inverse) {
  const std::string name = std::string("samples/") + (inverse ? "inverse " : "direct ") + nameOf(set);
  benchmark::RegisterBenchmark(name.c_str(),
                               [set, inverse](benchmark::State& state) {
                                 const auto count = static_cast<std::size_t>(state.range(0));
                                 const BatchDynamics dynamics(helix().manipulator(), set);
                                 Many poses(count);
                                 for ([[maybe_unused]] auto unused : state) {
                                   poses.solve(dynamics, inverse, 0, count);
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
                                   solveInThreads(dynamics, inverse, poses, static_cast<std::size_t>(state.range(0)));
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
