#include "validation/evidence/evidence.h"
#include "validation/replay/observed_order.h"

#include <algorithm>

namespace ursula {
namespace {

std::vector<RoadSample> roadSamples(const Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const RoundingProfile& profile = evidence.reference->profile;
  std::vector<RoadSample> out = runRoads(evidence.reference->roads(), evidence.samples, profile);
  for (std::size_t k = 0; k < further_road_count; ++k) {
    if (!evidence.spoil.further[k]) continue;
    const std::vector<RoadSample> spoilt = runRoads(evidence.spoil.further[k](scenario), evidence.samples, profile);
    for (std::size_t i = 0; i < out.size(); ++i) out[i].further[k] = spoilt[i].further[k];
  }
  return out;
}

std::vector<ReactionSample> reactionSamples(const Evidence& evidence) {
  std::vector<ReactionSample> out = evidence.reference->reactions();
  for (ReactionSample& sample : out)
    if (evidence.spoil.reactions) evidence.spoil.reactions(sample.recovered);
  return out;
}

/// The torques on trial are the right ones to the last bit, wherever somebody asked. Of a subject that wants to
/// foresee, to whom each question is dear, that is not asked.
bool answersAs(const AskedTorques& asked, const Evidence& evidence) {
  return evidence.right || (!evidence.plan.foresee && asked.sameFrom(evidence.plan.torques));
}

/// In the windows of the right torques, with what those say of the integration. True where the first window's is the
/// right torques' own.
bool replayWindows(Evidence& evidence) {
  bool first_is_right = true;
  evidence.windows = evidence.reference->windows;
  for (WindowedReplay& window : evidence.windows) {
    if (!evidence.spoil.replay && answersAs(window.replay.asked, evidence)) continue;
    if (&window == &evidence.windows.front()) first_is_right = false;
    ReplaySettings settings = settingsOf(*evidence.scenario, evidence.plan, window.window, 1);
    if (evidence.spoil.replay) evidence.spoil.replay(settings);
    window.replay = replay(*evidence.scenario, evidence.plan.torques, settings);
    window.replay.tolerance = evidence.plan.tolerance;  // that it is taken to have
  }
  return first_is_right;
}

void runReplays(bool ladder, Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const Reference& reference = *evidence.reference;
  const Spoil& spoil = evidence.spoil;
  const bool first_is_right = replayWindows(evidence);
  if (ladder) {
    const bool climbed = first_is_right && !spoil.ladder && answersAs(reference.ladder().asked, evidence);
    evidence.ladder = climbed
                          ? reference.ladder()
                          : climb(scenario, evidence.plan.torques, evidence.windows.front(), rungSettings(evidence));
    evidence.orders = spoil.lower_order ? observedOrders(scenario, true) : reference.orders();
  }
  evidence.stabilised =
      stabilisedReplay(spoil.feedback ? spoil.feedback(scenario) : scenario, *evidence.subject, reference.amplification,
                       evidence.samples, first_is_right && !spoil.feedback ? &reference.stabilised() : nullptr);
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
  out.right = right;
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

  out.samples = runPointwise(*out.scenario, subject, reference.instants, reference.profile, reference.simbody());
  if (spoil.sample) std::for_each(out.samples.begin(), out.samples.end(), spoil.sample);
  if (!out.answered()) return out;
  out.roads = roadSamples(out);
  out.invariances = runInvariances(*out.scenario, subject, out.samples);
  if (experiments.reactions) out.reactions = reactionSamples(out);
  runReplays(experiments.ladder, out);
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
