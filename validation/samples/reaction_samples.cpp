#include "validation/samples/reaction_samples.h"

#include "engines/simbody/simbody_loop.h"

namespace ursula {

std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<PointwiseSample>& samples,
                                         const std::vector<SimbodyAnswer>& simbody) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  std::vector<ReactionSample> out;
  out.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Motion<double>& motion = samples[k].motion;
    out.push_back({subject.reactions(motion), simbody[k].reactionsUnder(subject.torques(motion), loop, motion)});
  }
  return out;
}

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                         const std::vector<SimbodyAnswer>& simbody) {
  return runReactions(scenario, nocSubject(*scenario.manipulator, scenario.load), samples, simbody);
}

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  return runReactions(scenario, samples, simbodyAnswers(scenario, instantsOf(samples)));
}

}  // namespace ursula
