// Direct kinematics along the paper's helix: every pose for given actuated angles, and one pose tracked.

#include <benchmark/benchmark.h>

#include <vector>

#include "model/scenario.h"
#include "nocsolver/direct_kinematics.h"

namespace ursula::bench {
namespace {

/// Actuated angles with their rates at instants of the helix, 10 ms apart: what a controller would track.
struct ActuatedHelix {
  ActuatedHelix() : scenario(readScenario(URSULA_SCENARIOS "/paper-helix.toml")), kinematics(*scenario.manipulator) {
    Workspace<double> work;
    for (double t = 0; t < scenario.trajectory->duration(); t += 0.01) {
      kinematics.solver().inverseKinematics(scenario.trajectory->at(t), work);
      phi.push_back(kinematics.solver().angles(work).phi);
      phi_dot.push_back(kinematics.solver().rates(work).phi);
      phi_ddot.push_back(kinematics.solver().accelerations(work).phi);
      poses.push_back(*kinematics.poses(phi.back()).begin());
    }
  }

  Scenario scenario;
  DirectKinematics kinematics;
  std::vector<Vector6d> phi, phi_dot, phi_ddot;
  std::vector<PlatformPose> poses;
};

/// All poses, polished, with what each needs of the legs.
void allPoses(benchmark::State& state) {
  const ActuatedHelix helix;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(helix.kinematics.poses(helix.phi[k]));
    k = (k + 1) % helix.phi.size();
  }
}
BENCHMARK(allPoses);

/// One pose from that of 10 ms before.
void track(benchmark::State& state) {
  const ActuatedHelix helix;
  std::size_t k = 0, lost = 0;
  for ([[maybe_unused]] auto unused : state) {
    const std::optional<PlatformPose> pose = helix.kinematics.track(helix.phi[k + 1], helix.poses[k]);
    lost += pose ? 0 : 1;
    benchmark::DoNotOptimize(pose);
    k = (k + 1) % (helix.phi.size() - 1);
  }
  if (lost > 0) state.SkipWithError("a pose was lost");
}
BENCHMARK(track);

/// Twist and twist rate at a known pose, (24) and (25).
void motion(benchmark::State& state) {
  const ActuatedHelix helix;
  Workspace<double> work;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(helix.kinematics.motion(helix.poses[k], helix.phi_dot[k], helix.phi_ddot[k], work));
    k = (k + 1) % helix.phi.size();
  }
}
BENCHMARK(motion);

}  // namespace
}  // namespace ursula::bench
