#include "bench/peers/helix.h"

namespace ursula::bench {

Poses::Poses(const std::string& name)
    : scenario(readScenario(std::string(URSULA_SCENARIOS "/") + name + ".toml")), solver(*scenario.manipulator) {
  Workspace<double> work;
  for (int k = 0; k < count; ++k) {
    motions.push_back(scenario.trajectory->at(scenario.trajectory->duration() * (k + 0.5) / count));
    joints.push_back(jointMotion(solver, motions.back(), work));
    efforts.push_back(solver.inverseDynamics(motions.back(), work));
  }
}

const Poses& helix() {
  static const Poses poses("paper-helix");
  return poses;
}

JointMotion jointMotion(const Solver<double>& solver, const Motion<double>& motion, Workspace<double>& work) {
  solver.inverseKinematics(motion, work);
  return {solver.angles(work), solver.rates(work), solver.accelerations(work)};
}

}  // namespace ursula::bench
