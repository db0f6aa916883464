#include "validation/external.h"

#include <fmt/format.h>

#include <iterator>

#include "validation/attribution.h"
#include "validation/commanded_motion.h"
#include "validation/curves.h"
#include "validation/diagnosis.h"
#include "validation/external_replay.h"
#include "validation/finish.h"
#include "validation/judge_external.h"
#include "validation/timeseries.h"

namespace ursula {
namespace {

void addDiagnosis(const Diagnosis& diagnosis, ValidationResult& result) {
  if (diagnosis.summary.empty()) return;
  result.findings.emplace_back("torques that are off", diagnosis.deviation);
  result.findings.emplace_back("likely cause", diagnosis.cause);
  for (Check& check : result.checks)
    if (check.verdict == Verdict::fail)
      check.why += fmt::format(". Off: {}. Likely cause: {}", diagnosis.summary, diagnosis.cause);
}

void addFileFindings(const TorqueFile& file, ValidationResult& result) {
  result.findings.emplace_back("torque file", fmt::format("{} instants from {:.6g} to {:.6g} s, up to {} digits",
                                                          file.rows(), file.t.front(), file.t.back(), file.digits));
  if (!file.ignored.empty()) {
    std::string names;
    for (const std::string& name : file.ignored) names += (names.empty() ? "" : ", ") + name;
    result.findings.emplace_back("columns ignored", names);
  }
}

/// Of the first window; none where the torques throw the machine about, for then it says nothing of integration.
Ladder ladderOf(const Scenario& scenario, const ExternalReplay& replay) {
  if (replay.windows.empty()) return {};
  const WindowedReplay& first = replay.windows.front();
  if (!first.replay.gave_up.empty() || first.replay.left_path) return {};
  return climb(scenario, replay.torques, first);
}

}  // namespace

ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques) {
  ValidationResult result;
  result.scenario = scenario.name;
  const ExternalTorques external = runExternal(scenario, torques);
  result.checks = judgeCommandedMotion(scenario);
  std::vector<Check> of_file = judgeExternal(external);
  std::move(of_file.begin(), of_file.end(), std::back_inserter(result.checks));
  ExternalReplay replay = replayExternal(scenario, external);
  std::move(replay.checks.begin(), replay.checks.end(), std::back_inserter(result.checks));
  applyAcceptance(scenario.acceptance, result.checks);
  result.verdict = overall(result.checks);
  result.timeseries = validationSeries(external.samples, replay.windows);
  addFindings(external.samples, replay.windows, result);
  addCurves(external.samples, replay.windows, result);
  std::move(replay.findings.begin(), replay.findings.end(), std::back_inserter(result.findings));
  addBudget(attribute(external.samples, replay.windows, ladderOf(scenario, replay), result.checks), result);
  addFileFindings(external.file, result);
  addDiagnosis(diagnose(scenario, external), result);
  addProvenance(scenario, torques.file.filename().string(), result);
  return result;
}

ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv) {
  return validateExternal(scenario, readTorqueFile(torques_csv));
}

}  // namespace ursula
