#include "validation/validate.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/deadline.h"
#include "validation/checks/families.h"
#include "validation/checks/judges.h"
#include "validation/checks/tolerance.h"
#include "validation/evidence/evidence.h"
#include "validation/evidence/external_evidence.h"
#include "validation/findings/attribution.h"
#include "validation/findings/findings.h"
#include "validation/likely_cause.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/motion_check.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

void addFileFindings(const TorqueFile& file, ValidationResult& result) {
  if (!file.derived_from.empty()) return;
  result.findings.push_back({"torque file", fmt::format("{} instants from {:.6g} to {:.6g} s, up to {} digits",
                                                        file.rows(), file.t.front(), file.t.back(), file.digits)});
  if (!file.read_as.empty()) result.findings.push_back({"torque file read as", file.read_as});
  if (!file.ignored.empty()) {
    std::string names;
    for (const std::string& name : file.ignored) names += (names.empty() ? "" : ", ") + name;
    result.findings.push_back({"columns ignored", names});
  }
}

/// Converts units by powers of two, so no digit is lost.
TorqueFile inUnits(TorqueFile file, const FrameChange& natural) {
  const Units& units = natural.units;
  Vector6d effort;
  for (int k = 0; k < motor_count; ++k) effort(k) = natural.effort(k);
  for (std::size_t k = 0; k < file.rows(); ++k) {
    file.t[k] /= units.time;
    file.time_precision[k] /= units.time;
    file.torques[k] = file.torques[k].cwiseQuotient(effort);
    file.torque_precision[k] = file.torque_precision[k].cwiseQuotient(effort);
  }
  return file;
}

Evidence gatherExternal(const Scenario& given, const FrameChange& natural, const Scenario& scenario,
                        const ExternalTorques& external, const ExternalReplay& replay) {
  Evidence out;
  out.given = &given;
  out.natural = natural;
  out.scenario = &scenario;
  out.external = &external;
  out.amplification = replay.amplification.get();
  out.has.any_instant = out.has.kinematics = out.has.direct_dynamics = out.has.other_machines = false;
  out.samples = external.samples;
  askWitnesses(witnesses(), out);
  out.plan = replay.plan;
  out.scales = replay.scales;
  out.windows = replay.windows;
  out.spline = replay.spline;
  out.not_replayed = replay.not_replayed;
  out.replay_bound = replay.bound;
  return out;
}

void addFacts(const Evidence& evidence, const std::optional<ErrorBudget>& budget, ValidationResult& result) {
  result.timeseries =
      validationSeries(*evidence.scenario->manipulator, evidence.samples, evidence.windows, evidence.natural);
  addFindings(evidence.samples, evidence.windows, result, evidence.units());
  addCurves(evidence.samples, evidence.windows, evidence.natural, result);
  if (!evidence.not_replayed.empty()) result.findings.push_back({"replay", "none: " + evidence.not_replayed});
  if (!evidence.spline.empty()) result.findings.push_back({"spline", evidence.spline});
  if (budget) addBudget(*budget, result, evidence.units(), ErrorSource::between_samples);
}

/// Names the cause.
void addCause(const Scenario& scenario, const FrameChange& natural, const TorqueFile& file, const Evidence& evidence,
              const ExternalOptions& options, ValidationResult& result) {
  const Subject* solver = options.solver;
  const Scenario near_origin = relocated(scenario, natural.origin);
  if (solver == nullptr) return partLikelyCause()(near_origin, file, nullptr, result);
  Subject in_si = *solver;
  in_si.torques = [solver, origin = natural.origin](Motion<double> motion) {
    motion.p += origin;
    return solver->torques(motion);
  };
  const Subject in_natural = transformed(*solver, natural);
  const WrongSolver wrong{in_si, in_natural, evidence, options.no_cause ? options.no_cause() : ""};
  partLikelyCause()(near_origin, file, &wrong, result);
}

}  // namespace

ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, double time_limit,
                                  std::function<bool()> asked_to_end, int threads) {
  ExternalOptions options;
  options.time_limit = time_limit;
  options.asked_to_end = std::move(asked_to_end);
  options.threads = threads;
  return validateExternal(scenario, torques, options);
}

ValidationResult validateExternal(const Scenario& scenario, const TorqueFile& torques, const ExternalOptions& options) {
  const Deadline deadline(options.time_limit, options.asked_to_end);
  checkMotion(scenario);
  requireTellingTolerance(scenario);
  const FrameChange natural = naturalFrameChange(scenario);
  const Scenario in_natural = natural.transformed(scenario);
  const TorqueFile file = within(torques, scenario.trajectory->duration());
  ExternalTorques external;
  ExternalReplay replay;
  std::string out_of_time;
  try {
    external = runExternal(in_natural, inUnits(file, natural), deadline);
    if (torques.derived_from.empty()) replay = replayExternal(in_natural, external, natural.units, deadline);
  } catch (const OutOfTime& over) {
    out_of_time = over.what();
  }
  Evidence evidence = gatherExternal(scenario, natural, in_natural, external, replay);
  evidence.has.out_of_time = out_of_time;
  evidence.has.left_out_replays = !torques.derived_from.empty();
  const JudgedSubject of_file{torques.file.filename().string(), Formulation::external,
                              torques.is_read ? CalledBy::torques : CalledBy::program, torques.map};
  ValidationResult result = emptyResult(scenario, options.about.value_or(of_file));
  result.checks = judgeAll(evidence);
  try {
    if (options.more && out_of_time.empty())
      for (Check& check : options.more()) result.checks.push_back(std::move(check));
  } catch (const OutOfTime& over) {
    evidence.has.out_of_time = over.what();
  }
  std::optional<ErrorBudget> budget;
  if (torques.derived_from.empty())
    budget = attribute(*evidence.scenario, evidence.samples, evidence.windows, evidence.amplification, evidence.plan,
                       options.threads);
  deadline.remove();  // the rest is short and turns the finished part into a result
  result.odd_one = oddOneOut(external);
  result.findings.push_back({"odd one out of the formulations", inWords(result.odd_one)});
  addFacts(evidence, budget, result);
  result.deviation = effortDeviation(evidence, result.checks, result.odd_one);
  conclude(scenario, evidence.has, replay.between * natural.units.effort(), result);
  addFileFindings(file, result);
  if (replay.enough_rows > 0) result.needed = NeededRows{replay.enough_rows, file.rows()};
  if (result.verdict == Verdict::fail && !onlyOddEngineFails(result)) {
    if (partLikelyCause() != nullptr) addCause(scenario, natural, file, evidence, options, result);
    result.size = failureSize(in_natural, evidence.samples, scenario, natural, result);
  }
  addEffortWords(result);
  return result;
}

ValidationResult validateExternal(const Scenario& scenario, const std::filesystem::path& torques_csv) {
  requireWhole(scenario);
  return validateExternal(scenario, readTorqueFile(torques_csv, {}, scenario.manipulator->motors()));
}

}  // namespace ursula
