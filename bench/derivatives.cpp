// Derivatives of the efforts by the state, by every number of the machine, and the regressor.

#include "bench/benchmarks.h"
#include "parts/derivatives/effort_derivatives.h"

namespace ursula::bench {
namespace {

struct Differentiated {
  explicit Differentiated(const std::string& name) : poses(name), derivatives(poses.manipulator()) {}

  Poses poses;
  EffortDerivatives derivatives;
};

void registerMachine(const std::string& name) {
  const auto of = std::make_shared<const Differentiated>(name);
  const auto add = [&](const char* task, auto call) {
    benchmark::RegisterBenchmark((std::string(task) + "/" + name).c_str(), [of, call](benchmark::State& state) {
      roundPoses(state, [&](std::size_t k) { return call(of->derivatives, of->poses.motions[k]); });
    });
  };
  using Of = const EffortDerivatives&;
  using At = const Motion<double>&;
  add("derivatives_by_state", [](Of all, At motion) { return all.byState(motion); });
  add("derivatives_by_parameters", [](Of all, At motion) { return all.byParameters(motion); });
  add("regressor", [](Of all, At motion) { return all.regressor(motion); });
}

}  // namespace

void registerDerivatives() {
  for (const char* name : {"paper-helix", "flight-simulator", "hexa", "hexaglide", "mixture"}) registerMachine(name);
}

}  // namespace ursula::bench
