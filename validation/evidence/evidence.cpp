#include "validation/evidence/evidence.h"
#include "validation/replay/observed_order.h"

#include <algorithm>

namespace ursula {
namespace {

std::vector<RoadSample> roadSamples(const Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const RoundingProfile& profile = evidence.reference->profile;
  std::vector<RoadSample> out = runRoads(scenario, evidence.samples, profile);
  const auto replace = [&](const Spoil::Seen& seen, auto RoadSample::*road) {
    if (!seen) return;
    const std::vector<RoadSample> spoilt = runRoads(seen(scenario), evidence.samples, profile);
    for (std::size_t k = 0; k < out.size(); ++k) out[k].*road = spoilt[k].*road;
  };
  replace(evidence.spoil.twin, &RoadSample::twin);
  replace(evidence.spoil.maximal, &RoadSample::maximal);
  replace(evidence.spoil.mujoco, &RoadSample::mujoco);
  return out;
}

/// In the windows of the right torques, with what those say of the integration.
std::vector<WindowedReplay> replayed(const Evidence& evidence) {
  std::vector<WindowedReplay> out = evidence.reference->windows;
  for (WindowedReplay& window : out) {
    ReplaySettings settings = settingsOf(*evidence.scenario, evidence.plan, window.window, 1);
    if (evidence.spoil.replay) evidence.spoil.replay(settings);
    window.replay = replay(*evidence.scenario, evidence.plan.torques, settings);
    window.replay.tolerance = evidence.plan.tolerance;  // that it is taken to have
  }
  return out;
}

void runReplays(bool right, bool ladder, Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const Spoil& spoil = evidence.spoil;
  evidence.windows = right && !spoil.replay ? evidence.reference->windows : replayed(evidence);
  if (ladder) {
    evidence.ladder = climb(scenario, evidence.plan.torques, evidence.windows.front(), right, rungSettings(evidence));
    evidence.orders = spoil.lower_order ? observedOrders(scenario, true) : evidence.reference->orders();
  }
  evidence.stabilised = stabilisedReplay(spoil.feedback ? spoil.feedback(scenario) : scenario, *evidence.subject,
                                         evidence.reference->amplification, evidence.samples);
}

}  // namespace

bool Evidence::answered() const {
  return std::all_of(samples.begin(), samples.end(),
                     [](const PointwiseSample& sample) { return sample.refused.empty(); });
}

Evidence gather(const Scenario& given, const Reference& reference, const Subject& subject, bool right,
                const Spoil& spoil, const Experiments& experiments) {
  Evidence out;
  out.given = &given;
  out.natural = reference.natural;
  out.scenario = &reference.scenario;
  out.subject = &subject;
  out.reference = &reference;
  out.amplification = &reference.amplification;
  out.spoil = spoil;
  out.has.kinematics = static_cast<bool>(subject.kinematics);
  out.has.direct_dynamics = static_cast<bool>(subject.accelerations);
  out.has.other_machines = static_cast<bool>(subject.rebuilt);
  out.has.left_out_ladder = !experiments.ladder;
  out.has.left_out_reactions = !experiments.reactions;
  out.plan = reference.plan;
  const auto trajectory = reference.scenario.trajectory;
  out.plan.torques = [subject, trajectory](double t) { return subject.torques(trajectory->at(t)); };
  if (subject.foresee)
    out.plan.foresee = [subject, trajectory](const std::vector<double>& instants) {
      foresee(subject, *trajectory, instants);
    };
  out.scales = {reference.position_scale, reference.amplification.length(), reference.forces};

  out.samples = runPointwise(*out.scenario, subject, reference.instants, reference.profile);
  if (spoil.sample) std::for_each(out.samples.begin(), out.samples.end(), spoil.sample);
  if (!out.answered()) return out;
  out.roads = roadSamples(out);
  if (experiments.reactions) out.reactions = runReactions(*out.scenario, out.samples, spoil.reactions);
  runReplays(right, experiments.ladder, out);
  return out;
}

std::function<void(ReplaySettings&)> rungSettings(const Evidence& evidence) {
  const auto& spoil = evidence.spoil.ladder;
  const auto& foresee = evidence.plan.foresee;
  if (!foresee) return spoil;
  return [spoil, foresee](ReplaySettings& settings) {
    settings.foresee = foresee;
    if (spoil) spoil(settings);
  };
}

void lookCloser(Evidence& evidence, std::size_t window) {
  evidence.windows[window].closer = evidence.reference->closer(window);
}

}  // namespace ursula
