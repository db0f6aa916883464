// Direct kinematics along the paper's helix: every pose for given actuated angles, and one pose tracked.

#include <optional>

#include "bench/benchmarks.h"
#include "parts/poses/direct_kinematics.h"

namespace ursula::bench {
namespace {

/// Actuated angles with their rates at instants of the helix, 10 ms apart, as a controller would track them.
struct ActuatedHelix {
  ActuatedHelix() : kinematics(helix().manipulator()) {
    const Trajectory& trajectory = *helix().scenario.trajectory;
    Workspace<double> work;
    for (double t = 0; t < trajectory.duration(); t += 0.01) {
      kinematics.solver().inverseKinematics(trajectory.at(t), work);
      phi.push_back(kinematics.solver().angles(work).phi);
      phi_dot.push_back(kinematics.solver().rates(work).phi);
      phi_ddot.push_back(kinematics.solver().accelerations(work).phi);
      poses.push_back(*kinematics.poses(phi.back()).begin());
    }
  }

  DirectKinematics kinematics;
  std::vector<Vector6d> phi, phi_dot, phi_ddot;
  std::vector<PlatformPose> poses;
};

/// All poses, polished, with each leg's part.
void allPoses(benchmark::State& state) {
  const ActuatedHelix actuated;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(actuated.kinematics.poses(actuated.phi[k]));
    k = (k + 1) % actuated.phi.size();
  }
  countPoses(state);
}
/// Tracks one pose from that of 10 ms before.
void track(benchmark::State& state) {
  const ActuatedHelix actuated;
  std::size_t k = 0, lost = 0;
  for ([[maybe_unused]] auto unused : state) {
    const std::optional<PlatformPose> pose = actuated.kinematics.track(actuated.phi[k + 1], actuated.poses[k]);
    lost += pose ? 0 : 1;
    benchmark::DoNotOptimize(pose);
    k = (k + 1) % (actuated.phi.size() - 1);
  }
  countPoses(state);
  if (lost > 0) state.SkipWithError("a pose was lost");
}
/// Twist and twist rate at a known pose, (24) and (25).
void motion(benchmark::State& state) {
  const ActuatedHelix actuated;
  Workspace<double> work;
  std::size_t k = 0;
  for ([[maybe_unused]] auto unused : state) {
    benchmark::DoNotOptimize(
        actuated.kinematics.motion(actuated.poses[k], actuated.phi_dot[k], actuated.phi_ddot[k], work));
    k = (k + 1) % actuated.phi.size();
  }
  countPoses(state);
}
}  // namespace

void registerDirectKinematics() {
  benchmark::RegisterBenchmark("direct_kinematics/all poses", allPoses);
  benchmark::RegisterBenchmark("direct_kinematics/tracking", track);
  benchmark::RegisterBenchmark("direct_kinematics/twist and twist rate", motion);
}

}  // namespace ursula::bench
