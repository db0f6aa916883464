// Inverse and direct dynamics of machines with other kinds of legs against the paper's machine, turn by turn.

#include "bench/paper_helix.h"

namespace ursula::bench {
namespace {

/// Instants of a scenario that ships, with its efforts.
struct Moving {
  explicit Moving(const char* name)
      : scenario(readScenario(std::string(URSULA_SCENARIOS "/") + name + ".toml")), solver(*scenario.manipulator) {
    for (int k = 0; k < PaperHelix::count; ++k) {
      motions.push_back(scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / PaperHelix::count));
      efforts.push_back(solver.inverseDynamics(motions.back(), work));
    }
  }

  double inverse() {
    const double start = cpuTime();
    for (int i = 0; i < repeats; ++i)
      for (const Motion<double>& motion : motions) benchmark::DoNotOptimize(solver.inverseDynamics(motion, work));
    return (cpuTime() - start) / (repeats * PaperHelix::count);
  }
  double direct() {
    const double start = cpuTime();
    for (int i = 0; i < repeats; ++i)
      for (std::size_t k = 0; k < motions.size(); ++k)
        benchmark::DoNotOptimize(solver.directDynamics(motions[k], efforts[k], work));
    return (cpuTime() - start) / (repeats * PaperHelix::count);
  }

  static constexpr int repeats = 16;
  Scenario scenario;
  Solver<double> solver;
  Workspace<double> work;
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> efforts;
};

/// Medians over the turns, and how much slower than the paper's machine.
void againstThePaper(benchmark::State& state, const char* name, double (Moving::*run)()) {
  Moving paper("paper-helix"), other(name);
  std::vector<double> paper_s, other_s, ratio;
  for ([[maybe_unused]] auto unused : state) {
    paper_s.push_back((paper.*run)());
    other_s.push_back((other.*run)());
    ratio.push_back(other_s.back() / paper_s.back());
  }
  state.counters["paper_us"] = 1e6 * median(paper_s);
  state.counters["us"] = 1e6 * median(other_s);
  state.counters["of_paper"] = median(ratio);
}

void inverseDynamics(benchmark::State& state, const char* name) { againstThePaper(state, name, &Moving::inverse); }
void directDynamics(benchmark::State& state, const char* name) { againstThePaper(state, name, &Moving::direct); }

BENCHMARK_CAPTURE(inverseDynamics, UPS, "flight-simulator")->MinTime(1);
BENCHMARK_CAPTURE(inverseDynamics, RUS, "hexa")->MinTime(1);
BENCHMARK_CAPTURE(inverseDynamics, PUS, "hexaglide")->MinTime(1);
BENCHMARK_CAPTURE(inverseDynamics, mixture, "mixture")->MinTime(1);
BENCHMARK_CAPTURE(inverseDynamics, three_legs, "three-legs")->MinTime(1);
BENCHMARK_CAPTURE(directDynamics, UPS, "flight-simulator")->MinTime(1);
BENCHMARK_CAPTURE(directDynamics, RUS, "hexa")->MinTime(1);
BENCHMARK_CAPTURE(directDynamics, PUS, "hexaglide")->MinTime(1);

}  // namespace
}  // namespace ursula::bench
