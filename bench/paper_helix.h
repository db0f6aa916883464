#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "model/loops/simbody/simbody_loop.h"
#include "model/scenario.h"
#include "nocsolver/solver.h"

namespace ursula::bench {

/// The paper's helix at instants inside the motion, with what the roads need of each.
struct PaperHelix {
  static constexpr int count = 64;

  PaperHelix()
      : scenario(readScenario(URSULA_SCENARIOS "/paper-helix.toml")),
        solver(*scenario.manipulator),
        loop(*scenario.manipulator) {
    Workspace<double> work;
    for (int k = 0; k < count; ++k) {
      motions.push_back(scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / count));
      torques.push_back(solver.inverseDynamics(motions.back(), work));
      joints.push_back(loop.place(motions.back()));
      states.push_back(loop.state());
    }
  }

  Scenario scenario;
  Solver<double> solver;
  SimbodyLoop loop;
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> torques;
  std::vector<JointMotion> joints;
  std::vector<std::vector<double>> states;
};

/// Of this thread alone, so that what else runs on the machine is not counted. s
inline double cpuTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Times `ours(k)` and `simbody(k)` by turns over all instants, so that both meet the same machine, and leaves the
/// medians over the turns and their ratio as counters. The benchmark's own time is that of both.
template <class Ours, class Simbody>
void sideBySide(benchmark::State& state, Ours&& ours, Simbody&& simbody) {
  constexpr int repeats = 16;  // of ours for each one of Simbody's: a turn is to be long against the clock's grain
  std::vector<double> ours_s, simbody_s, ratio;
  for ([[maybe_unused]] auto unused : state) {
    const double start = cpuTime();
    for (int i = 0; i < repeats; ++i)
      for (int k = 0; k < PaperHelix::count; ++k) ours(k);
    const double between = cpuTime();
    for (int k = 0; k < PaperHelix::count; ++k) simbody(k);
    const double end = cpuTime();
    ours_s.push_back((between - start) / (repeats * PaperHelix::count));
    simbody_s.push_back((end - between) / PaperHelix::count);
    ratio.push_back(simbody_s.back() / ours_s.back());
  }
  state.counters["ours_us"] = 1e6 * median(ours_s);
  state.counters["simbody_us"] = 1e6 * median(simbody_s);
  state.counters["ratio"] = median(ratio);
}

}  // namespace ursula::bench
