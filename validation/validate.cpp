#include "validation/validate.h"

#include <algorithm>

#include "validation/finish.h"
#include "validation/judge_replay.h"
#include "validation/pointwise.h"
#include "validation/timeseries.h"
#include "validation/windows.h"

namespace ursula {

std::vector<double> equallySpaced(double duration, int count) {
  std::vector<double> instants;
  instants.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) instants.push_back(duration * k / (count - 1));
  return instants;
}

ValidationResult validate(const Scenario& scenario, const Subject& subject) {
  ValidationResult result;
  result.scenario = scenario.name;
  const auto samples =
      runPointwise(scenario, subject, equallySpaced(scenario.trajectory->duration(), scenario.simulation.samples));
  result.checks = judgePointwise(samples, static_cast<bool>(subject.kinematics));
  std::vector<WindowedReplay> windows;
  const bool answers =
      std::none_of(samples.begin(), samples.end(), [](const PointwiseSample& sample) { return !sample.refused.empty(); });
  if (answers) {
    const auto torques = [&](double t) { return subject.torques(scenario.trajectory->at(t)); };
    windows = replayInWindows(scenario, {torques, SampledLimit(samples), positionScale(samples),
                                         plannedStepRate(scenario.trajectory->duration())});
  }
  for (Check& check : judgeReplay(windows, positionScale(samples), samples.front().conditioning.length))
    result.checks.push_back(std::move(check));
  applyAcceptance(scenario.acceptance, result.checks);
  result.verdict = overall(result.checks);
  result.timeseries = validationSeries(samples, windows);
  addFindings(samples, windows, result);
  addProvenance(scenario, subject.name, result);
  return result;
}

ValidationResult validate(const Scenario& scenario) {
  return validate(scenario, nocSubject(*scenario.manipulator, scenario.load));
}

}  // namespace ursula
