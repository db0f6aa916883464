#include "validation/samples/reaction_samples.h"

#include "model/loops/simbody/simbody_loop.h"
#include "nocsolver/reactions.h"
#include "nocsolver/solver.h"

namespace ursula {

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  std::vector<ReactionSample> out;
  out.reserve(samples.size());
  for (const PointwiseSample& sample : samples) {
    const Vector6d torques = solver.inverseDynamics(sample.motion, work, loadAtP(scenario.load.get(), sample.motion));
    ReactionSample reactions;
    reactions.recovered = recoverReactions(solver, sample.motion, torques, work);
    loop.place(sample.motion);
    loop.accelerate(torques);
    reactions.simbody = loop.reactions();
    out.push_back(reactions);
  }
  return out;
}

}  // namespace ursula
