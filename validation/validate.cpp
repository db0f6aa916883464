#include "validation/validate.h"

#include <algorithm>
#include <iterator>

#include "validation/attribution.h"
#include "validation/curves.h"
#include "validation/feedback.h"
#include "validation/finish.h"
#include "validation/invariance.h"
#include "validation/judge_replay.h"
#include "validation/ladder.h"
#include "validation/motion_check.h"
#include "validation/pointwise.h"
#include "validation/roads.h"
#include "validation/timeseries.h"
#include "validation/windows.h"

namespace ursula {

std::vector<double> equallySpaced(double duration, int count) {
  std::vector<double> instants;
  instants.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) instants.push_back(duration * k / (count - 1));
  return instants;
}

namespace {

/// What the replays show: ladder, feedback and attribution beside the judged windows.
struct Motions {
  std::vector<WindowedReplay> windows;
  Ladder ladder;
};

void append(std::vector<Check>& checks, std::vector<Check> more) {
  std::move(more.begin(), more.end(), std::back_inserter(checks));
}

Motions judgeMotions(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                     const ValidationOptions& options, std::vector<Check>& checks) {
  const Amplification amplification = linearised(scenario);
  const double position_scale = positionScale(samples);
  const SimbodyLoop::TorqueHistory torques = [&](double t) { return subject.torques(scenario.trajectory->at(t)); };
  Motions motions;
  ReplayPlan plan{torques, SampledLimit(samples), position_scale, plannedStepRate(scenario.trajectory->duration())};
  plan.tolerance = reachableTolerance(scenario, plan.step_rate);
  plan.max_evaluations = enoughEvaluations(plan.step_rate, scenario.trajectory->duration());
  motions.windows = replayInWindows(scenario, amplification, plan);
  append(checks, judgeReplay(motions.windows, position_scale, amplification.length(), loopForces(samples)));
  if (options.ladder) {
    motions.ladder = climb(scenario, torques, motions.windows.front());
    append(checks, judgeLadder(motions.ladder, motions.windows.front(), position_scale));
  }
  checks.push_back(judgeFeedback(scenario, subject, amplification, samples));
  return motions;
}

}  // namespace

ValidationResult validate(const Scenario& scenario, const Subject& subject, const ValidationOptions& options) {
  checkMotion(scenario);
  ValidationResult result;
  result.scenario = scenario.name;
  const auto samples =
      runPointwise(scenario, subject, equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples));
  result.checks = judgePointwise(samples, static_cast<bool>(subject.kinematics));
  const bool answers = std::none_of(samples.begin(), samples.end(),
                                    [](const PointwiseSample& sample) { return !sample.refused.empty(); });
  Motions motions;
  TimeSeries reactions;
  if (answers) {
    const std::vector<RoadSample> roads = runRoads(scenario, samples);
    append(result.checks, judgeRoads(roads));
    append(result.checks, judgeInvariances(scenario, subject, samples));
    if (options.reactions) result.checks.push_back(judgeReactions(scenario, samples, &reactions));
    motions = judgeMotions(scenario, subject, samples, options, result.checks);
    result.findings.emplace_back("odd one out of the roads", oddOneOut(roads));
  } else {
    append(result.checks, judgeReplay({}, 0, 0, {}));
  }
  applyAcceptance(scenario.acceptance, result.checks);
  result.verdict = overall(result.checks);
  addFindings(samples, motions.windows, result);
  addBudget(attribute(samples, motions.windows, motions.ladder, result.checks), result);
  result.timeseries = validationSeries(samples, motions.windows);
  for (std::size_t k = 0; k < reactions.names.size(); ++k)
    result.timeseries.add(reactions.names[k], std::move(reactions.columns[k]));
  addCurves(samples, motions.windows, result);
  if (!motions.ladder.rungs.empty()) result.curves.emplace_back("Work and precision", workPrecision(motions.ladder));
  addProvenance(scenario, subject.name, result);
  return result;
}

ValidationResult validate(const Scenario& scenario) {
  return validate(scenario, nocSubject(*scenario.manipulator, scenario.load));
}

}  // namespace ursula
