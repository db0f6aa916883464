// Derivatives of the efforts by the state, by every number of the machine, and the regressor; inverse dynamics of the
// same machine beside them.

#include "bench/paper_helix.h"
#include "nocsolver/effort_derivatives.h"

namespace ursula::bench {
namespace {

struct Differentiated {
  explicit Differentiated(const char* name)
      : scenario(readScenario(std::string(URSULA_SCENARIOS "/") + name + ".toml")),
        derivatives(*scenario.manipulator),
        fast(*scenario.manipulator) {
    for (int k = 0; k < PaperHelix::count; ++k)
      motions.push_back(scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / PaperHelix::count));
  }
  template <class F>
  double secondsOf(const F& call) const {
    const double start = cpuTime();
    for (const Motion<double>& motion : motions) benchmark::DoNotOptimize(call(motion));
    return (cpuTime() - start) / PaperHelix::count;
  }

  Scenario scenario;
  EffortDerivatives derivatives;
  FastDynamics<double> fast;
  std::vector<Motion<double>> motions;
};

void derivatives(benchmark::State& state, const char* name) {
  const Differentiated of(name);
  std::vector<double> inverse, by_state, by_parameters, regressor;
  for ([[maybe_unused]] auto unused : state) {
    inverse.push_back(of.secondsOf([&](const auto& motion) { return of.fast.inverseDynamics(motion); }));
    by_state.push_back(of.secondsOf([&](const auto& motion) { return of.derivatives.byState(motion); }));
    by_parameters.push_back(of.secondsOf([&](const auto& motion) { return of.derivatives.byParameters(motion); }));
    regressor.push_back(of.secondsOf([&](const auto& motion) { return of.derivatives.regressor(motion); }));
  }
  state.counters["inverse_us"] = 1e6 * median(inverse);
  state.counters["by_state_us"] = 1e6 * median(by_state);
  state.counters["by_parameters_us"] = 1e6 * median(by_parameters);
  state.counters["regressor_us"] = 1e6 * median(regressor);
}

BENCHMARK_CAPTURE(derivatives, URS, "paper-helix")->MinTime(1);
BENCHMARK_CAPTURE(derivatives, UPS, "flight-simulator")->MinTime(1);
BENCHMARK_CAPTURE(derivatives, RUS, "hexa")->MinTime(1);
BENCHMARK_CAPTURE(derivatives, PUS, "hexaglide")->MinTime(1);
BENCHMARK_CAPTURE(derivatives, mixture, "mixture")->MinTime(1);

}  // namespace
}  // namespace ursula::bench
