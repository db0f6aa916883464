#include "validation/samples/reaction_samples.h"

#include "engines/simbody/simbody_loop.h"
#include "validation/limits/engine_view.h"

namespace ursula {

template <class Sample>
std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<Sample>& samples) {
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  std::vector<ReactionSample> out(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Motion<double>& motion = samples[k].motion;
    out[k].recovered = subject.reactions(motion);
    loop.place(motion);
    loop.accelerate(subject.torques(motion));
    const Reactions simbody = loop.reactions();
    for (std::size_t leg = 0; leg < leg_count; ++leg)
      out[k].errors[leg] = distance(out[k].recovered[leg], simbody[leg], samples[k].conditioning.length);
  }
  return out;
}

template std::vector<ReactionSample> runReactions(const Scenario&, const Subject&, const std::vector<Conditions>&);
template std::vector<ReactionSample> runReactions(const Scenario&, const Subject&, const std::vector<PointwiseSample>&);

std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples) {
  return runReactions(scenario, nocSubject(*scenario.manipulator, scenario.load), samples);
}

}  // namespace ursula
