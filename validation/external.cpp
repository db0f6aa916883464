#include "validation/external.h"

#include <fmt/format.h>

#include <iterator>

#include "validation/attribution.h"
#include "validation/curves.h"
#include "validation/diagnosis.h"
#include "validation/external_replay.h"
#include "validation/finish.h"
#include "validation/judge_external.h"
#include "validation/motion_check.h"
#include "validation/presentation.h"
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

/// In other units; all are powers of two, so that no digit is lost.
TorqueFile inUnits(TorqueFile file, const Units& units) {
  for (std::size_t k = 0; k < file.rows(); ++k) {
    file.t[k] /= units.time;
    file.time_precision[k] /= units.time;
    file.torques[k] /= units.torque();
    file.torque_precision[k] /= units.torque();
  }
  return file;
}

void addReplay(const Scenario& scenario, const ExternalTorques& external, const Units& units,
               ValidationResult& result) {
  ExternalReplay replay = replayExternal(scenario, external, units);
  std::move(replay.checks.begin(), replay.checks.end(), std::back_inserter(result.checks));
  result.timeseries = validationSeries(external.samples, replay.windows);
  addFindings(external.samples, replay.windows, result, units);
  addCurves(external.samples, replay.windows, result);
  std::move(replay.findings.begin(), replay.findings.end(), std::back_inserter(result.findings));
  const ErrorBudget budget = replay.windows.empty() ? ErrorBudget{}
                                                    : attribute(scenario, external.samples, replay.windows,
                                                                *replay.amplification, replay.plan);
  addBudget(budget, result, units);
}

}  // namespace

ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques) {
  checkMotion(scenario);
  const Presentation natural = naturalPresentation(scenario);
  const Scenario here = natural.of(scenario);
  ValidationResult result;
  result.scenario = scenario.name;
  const TorqueFile file = within(torques, scenario.trajectory->duration());
  const ExternalTorques external = runExternal(here, inUnits(file, natural.units));
  result.checks = judgeExternal(external, natural.units);
  addReplay(here, external, natural.units, result);
  restore(natural, result);
  addPicture(scenario, result);
  prependMotionChecks(scenario, result);
  SubjectHas has;
  has.any_instant = has.kinematics = has.direct_dynamics = has.other_machines = false;
  listEveryCheck(scenario, has, result);
  judgeByUser(scenario.acceptance, result);
  addFileFindings(file, result);
  if (result.verdict == Verdict::fail || result.limits == LimitBy::user) {
    const Scenario relocated = ursula::relocated(scenario, natural.origin);  // in SI: its words are
    addDiagnosis(diagnose(relocated, runExternal(relocated, file)), result);
  }
  addProvenance(scenario, torques.file.filename().string(), result);
  return result;
}

ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv) {
  return validateExternal(scenario, readTorqueFile(torques_csv));
}

}  // namespace ursula
