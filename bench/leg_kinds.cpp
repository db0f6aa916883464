// Machines with legs of other kinds, one pose at a time and in batches.

#include "bench/benchmarks.h"

namespace ursula::bench {
namespace {

struct Moving {
  explicit Moving(const std::string& name)
      : poses(name), fast(poses.manipulator()), batch(poses.manipulator()), found(Poses::count), faults(Poses::count) {}

  Poses poses;
  FastDynamics<double> fast;
  BatchDynamics batch;
  std::vector<Vector6d> found;
  std::vector<PoseFault> faults;
};

void registerMachine(const std::string& name) {
  const auto machine = std::make_shared<Moving>(name);
  benchmark::RegisterBenchmark(("inverse_of_kind/" + name).c_str(), [machine](benchmark::State& state) {
    roundPoses(state, [&](std::size_t k) { return machine->fast.inverseDynamics(machine->poses.motions[k]); });
  });
  benchmark::RegisterBenchmark(("direct_of_kind/" + name).c_str(), [machine](benchmark::State& state) {
    roundPoses(state, [&](std::size_t k) {
      return machine->fast.directDynamics(machine->poses.motions[k], machine->poses.efforts[k]);
    });
  });
  benchmark::RegisterBenchmark(("inverse_batch_of_kind/" + name).c_str(), [machine](benchmark::State& state) {
    for ([[maybe_unused]] auto unused : state) {
      machine->batch.inverseDynamics(machine->poses.motions.data(), Poses::count, machine->found.data(),
                                     machine->faults.data());
      benchmark::ClobberMemory();
    }
    countPoses(state, Poses::count);
  });
}

}  // namespace

void registerLegKinds() {
  for (const char* name : {"flight-simulator", "hexa", "hexaglide", "mixture", "three-legs"}) registerMachine(name);
}

}  // namespace ursula::bench
