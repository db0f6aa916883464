// Efforts of mechanisms from the motors' motion, by this program and by each engine's exact recipe.

#include <stdexcept>

#include "bench/benchmarks.h"
#include "parts/engines/loop_engine.h"
#include "validation/mechanism/validate_mechanism.h"

namespace ursula::bench {
namespace {

/// Instants of a shipped mechanism's motion, all of one lap, so that each pose is near the one before.
struct MovingLoop {
  explicit MovingLoop(const std::string& name)
      : scenario(readMechanism(URSULA_SCENARIOS "/mechanisms/" + name + ".toml")), along(scenario) {
    for (std::size_t k = 0; k < Poses::count; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(Poses::count);
      motions.push_back(scenario.trajectory->at(share * scenario.trajectory->duration()));
      efforts.push_back(along.motion().inverseDynamics(motions.back().t, work));
    }
  }

  MechanismScenario scenario;
  MechanismAlong along;
  LoopWork work;
  std::vector<MotorMotion> motions;
  std::vector<Eigen::VectorXd> efforts;
};

/// Throws std::runtime_error if an engine's efforts are not those of this program: then nothing is timed.
void requireAgreement(MechanismCalls& engine, const MovingLoop& loop, const std::string& name) {
  for (std::size_t k = 0; k < Poses::count; ++k)
    if (!((engine.efforts(Recipe::exact, loop.motions[k]) - loop.efforts[k]).norm() <= 1e-12 * loop.efforts[k].norm()))
      throw std::runtime_error(name + " does not agree on a mechanism: nothing is timed");
}

void registerMechanism(const std::string& name) {
  const auto loop = std::make_shared<MovingLoop>(name);
  const std::string task = "inverse_of_mechanism/" + name + ": ";
  benchmark::RegisterBenchmark((task + "ursula").c_str(), [loop](benchmark::State& state) {
    roundPoses(state,
               [&](std::size_t k) { return loop->along.motion().inverseDynamics(loop->motions[k].t, loop->work); });
  });
  for (const LoopEngineKind& kind : loopEngines()) {
    if (!kind.available() || kind.make_mechanism == nullptr) continue;
    const std::shared_ptr<MechanismCalls> engine = kind.make_mechanism(*loop->scenario.mechanism);
    requireAgreement(*engine, *loop, kind.name);
    benchmark::RegisterBenchmark((task + kind.name).c_str(), [loop, engine](benchmark::State& state) {
      roundPoses(state, [&](std::size_t k) { return engine->efforts(Recipe::exact, loop->motions[k]); });
    });
  }
}

}  // namespace

void registerMechanisms() {
  for (const char* name : {"fourbar", "delta"}) registerMechanism(name);
}

}  // namespace ursula::bench
