#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "bench/peers/agreement.h"
#include "bench/peers/helix.h"
#include "bench/peers/peer.h"
#include "parts/fast/batch_dynamics.h"

namespace ursula::bench {

// Names are TASK/WHO or TASK/WHO/HOW MUCH; tools/performance.py makes tables from them.

/// Adds the time of one pose as a counter, s; each iteration does `poses` of them.
void countPoses(benchmark::State& state, double poses = 1);

/// Does one pose in each iteration, round and round.
template <class Do>
void roundPoses(benchmark::State& state, Do&& act) {
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(act(k));
    k = (k + 1) % Poses::count;
  }
  countPoses(state);
}

/// Returns the instruction sets of this processor, the widest last.
std::vector<InstructionSet> instructionSets();

using Peers = std::vector<std::unique_ptr<Peer>>;

/// The solver's formulations and the peers on the paper's helix.
void registerSideBySide(const Peers& peers);
/// Returns the answers of the solver's formulations at the timed poses.
std::vector<Answers> ownAnswers();

/// Batches by instruction set, number of samples and threads.
void registerBatches();
/// Machines with legs of other kinds.
void registerLegKinds();
/// Mechanisms, beside the exact recipe of each engine.
void registerMechanisms();
/// Derivatives of the efforts of machines of each kind.
void registerDerivatives();
/// Direct-dynamics simulation of the helix.
void registerSimulations();
/// All poses, tracking, and twists at a known pose.
void registerDirectKinematics();

}  // namespace ursula::bench
