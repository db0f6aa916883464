#include "validation/samples/reaction_samples.h"

#include "model/loops/simbody/simbody_loop.h"
#include "nocsolver/reactions.h"
#include "nocsolver/solver.h"

namespace ursula {

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                         const std::vector<SimbodyAnswer>& simbody) {
  const Solver<double> solver(*scenario.manipulator);
  Workspace<double> work;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  std::vector<ReactionSample> out;
  out.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PointwiseSample& sample = samples[k];
    const Vector6d torques = solver.inverseDynamics(sample.motion, work, loadAtP(scenario.load.get(), sample.motion));
    ReactionSample reactions;
    reactions.recovered = recoverReactions(solver, sample.motion, torques, work);
    reactions.simbody = simbody[k].reactionsUnder(torques, loop, sample.motion);
    out.push_back(reactions);
  }
  return out;
}

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  return runReactions(scenario, samples, simbodyAnswers(scenario, instantsOf(samples)));
}

}  // namespace ursula
