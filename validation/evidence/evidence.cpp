#include "validation/evidence/evidence.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/deadline.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/observed_order.h"
#include "validation/replay/windows.h"
#include "validation/subject/asked_instants.h"
#include "validation/subject/subject.h"

namespace ursula {
namespace {

/// Computes the subject's reactions if it has its own or an injected fault changes them. The reference has those of the
/// right solver.
void gatherReactions(Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const bool own = evidence.subject->reactions && !evidence.right;
  if (own || evidence.fault.reactions) {
    Subject subject = own ? *evidence.subject : nocSubject(*scenario.manipulator, scenario.load);
    if (evidence.fault.reactions)
      subject.reactions = [right = subject.reactions, &evidence](const Motion<double>& motion) {
        Reactions out = right(motion);
        evidence.fault.reactions(out);
        return out;
      };
    evidence.own_reactions = runReactions(evidence.reference->in_simbody, subject, evidence.samples);
  } else {
    evidence.reference->reactions();  // computes them now, within this stage's progress
  }
  evidence.has_reactions = true;
}

/// Whether the subject gives the right replay's torques to the bit. A subject that foresees torques counts as
/// different, because its answers are expensive.
bool gaveRightTorques(const AskedTorques& asked, const Evidence& evidence) {
  return evidence.right || (!evidence.plan.foresee && asked.sameFrom(evidence.plan.torques));
}

/// Replays each window, or reuses the right torques' replay. Returns whether the first was reused.
bool replayWindows(Evidence& evidence) {
  bool first_is_right = true;
  std::vector<WindowedReplay> windows = evidence.reference->replays().windows;
  for (WindowedReplay& window : windows) {
    if (!evidence.fault.replay && gaveRightTorques(window.replay.asked, evidence)) continue;
    if (&window == &windows.front()) first_is_right = false;
    ReplaySettings settings = settingsOf(*evidence.scenario, evidence.plan, window.window, 1);
    if (evidence.fault.replay) evidence.fault.replay(settings);
    window.replay = replay(*evidence.scenario, evidence.plan.torques, settings);
    window.replay.tolerance = evidence.plan.tolerance;  // which limits assume, also if a fault changed it
  }
  evidence.windows = std::move(windows);  // all or none
  return first_is_right;
}

void runReplays(bool ladder, Evidence& evidence) {
  const Scenario& scenario = *evidence.scenario;
  const Reference& reference = *evidence.reference;
  const InjectedFault& fault = evidence.fault;
  const bool first_is_right = replayWindows(evidence);
  if (ladder) {
    const bool climbed = first_is_right && !fault.ladder && gaveRightTorques(reference.ladder().asked, evidence);
    evidence.ladder = climbed ? reference.ladder()
                              : replayLadder(scenario, evidence.plan.torques, evidence.windows.front(),
                                             rungSettings(evidence), reference.deadline);
    evidence.orders = fault.lower_order ? observedOrders(scenario, true, reference.deadline) : reference.orders();
  }
  Subject driving = *evidence.subject;
  if (driving.most_questions > 0) {
    driving.torques = [&evidence](const Motion<double>& motion) { return evidence.plan.torques(motion.t); };
    driving.foresee = nullptr;
  }
  evidence.stabilised =
      stabilisedReplay(fault.feedback ? fault.feedback(scenario) : scenario, driving, reference.replays().amplification,
                       reference.rounding().along(),
                       first_is_right && !fault.feedback ? &reference.stabilised() : nullptr, reference.deadline);
}

/// Runs every experiment at the samples. Their shares of the work were measured with many samples.
void gatherSamples(const Experiments& experiments, Evidence& out) {
  const auto tell = [&experiments](double share) {
    if (experiments.progress) experiments.progress(share);
  };
  const Reference& reference = *out.reference;
  out.samples = runPointwise(*out.scenario, *out.subject, reference.instants, reference.rounding().profile,
                             reference.simbody(), reference.deadline, out.fault.formulations.simbody);
  if (out.fault.sample) std::for_each(out.samples.begin(), out.samples.end(), out.fault.sample);
  if (!out.answered()) return;
  tell(0.45);
  out.engines = runEngines(reference.engines(), out.samples, reference.rounding().profile);
  tell(0.7);
  out.invariances = runInvariances(*out.scenario, *out.subject, out.samples);
  out.complement = runComplement(*out.scenario->manipulator, *out.subject, out.samples);
  askWitnesses(experiments.witnesses, out);
  tell(0.8);
  if (experiments.reactions) gatherReactions(out);
  tell(1);
}

/// Asks a subject of few questions between the samples, and at some samples again, in another order. Some questions are
/// left for its terms apart, if it is wrong. Replays then run on all of these answers.
void askBetween(Evidence& out) {
  constexpr std::size_t again = 32;
  constexpr int for_causes = 128, least = 64;
  const Subject& subject = *out.subject;
  const Trajectory& trajectory = *out.scenario->trajectory;
  const std::vector<double>& samples = out.reference->instants;
  const int left = std::max(least, subject.most_questions - static_cast<int>(samples.size() + again) - for_causes);
  const auto ask = [&](const std::vector<double>& instants) {
    foresee(subject, trajectory, instants);
    for (const double t : instants) subject.torques(trajectory.at(t));
  };
  ask(goldenInstants(trajectory.duration(), left * 4 / 5));  // not in order of time
  std::vector<Answered> answers = subject.answers();
  sortByTime(answers);
  ask(curvedInstants(answers, left / 5));
  std::vector<double> repeated;
  for (std::size_t k = again; k-- > 0;) repeated.push_back(samples[k * (samples.size() - 1) / (again - 1)]);
  ask(repeated);
}

void planReplays(Evidence& out) {
  const RightReplays& right = out.reference->replays();
  out.amplification = &right.amplification;
  out.plan = right.plan;
  const Subject subject = *out.subject;
  const auto trajectory = out.scenario->trajectory;
  if (subject.most_questions > 0) {
    const auto answers = std::make_shared<const InterpolatedAnswers>(right.plan.torques, subject.answers());
    out.plan.torques = [answers](double t) { return (*answers)(t); };
    out.spline = "driven by the NOC's torques plus the interpolated difference of the answers";
  } else {
    out.plan.torques = [subject, trajectory](double t) { return subject.torques(trajectory->at(t)); };
  }
  if (subject.foresee && subject.most_questions == 0)
    out.plan.foresee = [subject, trajectory](const std::vector<double>& instants) {
      foresee(subject, *trajectory, instants);
    };
  out.scales = {out.reference->rounding().position_scale, right.amplification.length(),
                out.reference->rounding().forces};
}

}  // namespace

SubjectHas::SubjectHas(const Subject& subject)
    : kinematics(static_cast<bool>(subject.kinematics)),
      direct_dynamics(static_cast<bool>(subject.accelerations)),
      complement(static_cast<bool>(subject.complement)),
      other_machines(static_cast<bool>(subject.rebuilt)) {}

const std::vector<ReactionSample>& Evidence::reactions() const {
  return has_reactions && own_reactions.empty() ? reference->reactions() : own_reactions;
}

bool Evidence::answered() const {
  return std::all_of(samples.begin(), samples.end(),
                     [](const PointwiseSample& sample) { return sample.refused.empty(); });
}

Evidence gather(const Scenario& given, const Reference& reference, const Subject& subject, bool right,
                const InjectedFault& fault, const Experiments& experiments) {
  Evidence out;
  out.given = &given;
  out.natural = reference.natural;
  out.scenario = &reference.scenario;
  out.subject = &subject;
  out.reference = &reference;
  out.right = right;
  out.fault = fault;
  out.has = SubjectHas(subject);
  out.has.left_out_ladder = !experiments.ladder;
  out.has.left_out_reactions = !experiments.reactions;
  out.has.left_out_replays = experiments.samples_alone;
  try {
    gatherSamples(experiments, out);
    if (experiments.samples_alone) return out;
    if (subject.most_questions > 0 && out.answered()) askBetween(out);
    planReplays(out);
    if (out.answered()) runReplays(experiments.ladder, out);
  } catch (const OutOfTime& over) {
    out.has.out_of_time = over.what();
  }
  return out;
}

void askWitnesses(const std::vector<Witness>& witnesses, Evidence& evidence) {
  for (const Witness& witness : witnesses) evidence.witnessed[witness.name] = witness.ask(evidence);
}

std::function<void(ReplaySettings&)> rungSettings(const Evidence& evidence) {
  const auto& fault = evidence.fault.ladder;
  const auto& foresee = evidence.plan.foresee;
  if (!foresee) return fault;
  return [fault, foresee](ReplaySettings& settings) {
    settings.foresee = foresee;
    if (fault) fault(settings);
  };
}

void refineWindow(Evidence& evidence, std::size_t window) {
  evidence.windows[window].closer = evidence.reference->closer(window);
}

namespace {

/// Time of one evaluation of the closed loop's derivatives, s.
double evaluationSeconds(const Scenario& scenario) {
  using Clock = std::chrono::steady_clock;
  constexpr int evaluations = 50;
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::ball_per_leg, scenario.load);
  const Motion<double> start = scenario.trajectory->at(0);
  const Vector6d torques = nocSubject(*scenario.manipulator, scenario.load).torques(start);
  loop.place(start);
  const std::vector<double> x = loop.state();
  std::vector<double> rate(x.size());
  const Clock::time_point begun = Clock::now();
  for (int k = 0; k < evaluations; ++k) loop.derivative(0, x.data(), torques, rate.data());
  return std::chrono::duration<double>(Clock::now() - begun).count() / evaluations;
}

}  // namespace

WorkParts workParts(const Scenario& scenario) {
  constexpr double of_step = 150, of_interval = 10;  // evaluations: of all replays for a step, of growth
  const double duration = scenario.trajectory->duration(), samples = scenario.simulation.samples;
  const double over_time = of_step * plannedStepRate(duration) * duration + of_interval * linearisedIntervals(duration);
  WorkParts out;
  out.reference = 0.35 * over_time + samples;
  out.samples = 28 * samples;
  out.replays = 0.45 * over_time;
  out.checks = 0.1 * over_time;
  out.sources = 0.1 * over_time + samples;  // including the time series
  return out;
}

double workSeconds(const Scenario& scenario) { return evaluationSeconds(scenario) * workParts(scenario).total(); }

}  // namespace ursula
