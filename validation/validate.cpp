#include "validation/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "validation/checks/families.h"
#include "validation/checks/judges.h"
#include "validation/checks/tolerance.h"
#include "validation/evidence/evidence.h"
#include "validation/evidence/external_evidence.h"
#include "validation/evidence/reference.h"
#include "validation/findings/attribution.h"
#include "validation/findings/findings.h"
#include "validation/likely_cause.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/motion_check.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

void addOddOne(const Evidence& evidence, ValidationResult& result) {
  result.odd_one = oddOneOut(evidence.engines);
  const bool between = fails(result.checks, "torque.between") && !fails(result.checks, "torque.pointwise");
  result.findings.push_back(
      {"odd one out of the formulations",
       (between ? "the torques under test, between the samples; at the samples: " : "") + inWords(result.odd_one)});
}

/// Releases the judged data, because the time series needs the memory.
void addFacts(const std::optional<ErrorBudget>& budget, Evidence& evidence, ValidationResult& result) {
  if (evidence.answered()) addOddOne(evidence, result);
  evidence.engines = std::vector<EngineSample>();
  evidence.invariances = std::vector<InvarianceSamples>();
  addFindings(evidence.samples, evidence.windows, result, evidence.units());
  if (budget) addBudget(*budget, result, evidence.units());
  const FrameChange& from = evidence.natural;
  result.timeseries = validationSeries(*evidence.scenario->manipulator, evidence.samples, evidence.windows, from);
  if (!evidence.reactions().empty())
    addReactionColumns(*evidence.scenario->manipulator, evidence.reactions(), from, result.timeseries);
  addCurves(evidence.samples, evidence.windows, from, result);
  if (!evidence.ladder.rungs.empty()) result.curves.push_back(workPrecision(evidence.ladder, from.units));
}

/// Reports progress; `done` is the completed part of all work.
void reportProgress(const ValidationOptions& options, const WorkParts& work, double done, const char* now) {
  if (options.progress) options.progress(done / work.total(), now);
}

/// Says what a solver of few questions was asked, and what that may miss.
void addQuestions(const Evidence& evidence, ValidationResult& result) {
  const Subject& subject = *evidence.subject;
  const Check* between = findCheck(result.checks, "torque.between");
  if (subject.most_questions == 0 || between == nullptr || !std::isfinite(between->gap)) return;
  result.findings.push_back(
      {"questions", fmt::format("{} before a cause was sought, up to {:.3g} s apart: an error that is shorter may be "
                                "missed. The replays ran on the NOC's torques plus the interpolated difference of the "
                                "answers. A thorough run asks at every instant that an integrator wants (--thorough, "
                                "in Python thorough=True)",
                                subject.answers().size(), between->gap)});
}

/// Judges all answers that an external solver ever gave, instead of those that torque.between requested.
void judgeEveryAnswer(const Evidence& evidence, std::vector<Check>& checks) {
  const auto between =
      std::find_if(checks.begin(), checks.end(), [](const Check& check) { return check.name == "torque.between"; });
  if (!evidence.subject->answers || between == checks.end() || between->reason == Reason::not_made) return;
  std::vector<Check> all = {judgeAnswers(*evidence.scenario, evidence.subject->answers(), evidence.samples,
                                         evidence.reference->rounding().profile, evidence.units())};
  checksInSi(evidence.units(), all);
  *between = all.front();
}

/// A solver's answers at the samples, as a file with all digits; empty if an answer is not finite.
GivenTorques answersOf(const Evidence& evidence, const std::string& name) {
  GivenTorques out;
  out.name = name;
  for (const PointwiseSample& sample : evidence.samples) {
    if (!sample.refused.empty() || !sample.torques.allFinite()) return {};
    out.t.push_back(sample.motion.t * evidence.natural.units.time);
    out.torques.push_back(sample.torques);
    for (int k = 0; k < motor_count; ++k) out.torques.back()(k) *= evidence.natural.effort(k);
  }
  return out;
}

/// Wraps a subject that works in natural units for questions in SI, with positions relative to their origin.
Subject inSi(const Subject& subject, const FrameChange& natural) {
  Subject out;
  out.name = subject.name;
  out.torques = [torques = subject.torques, to_natural = natural.unshifted()](const Motion<double>& motion) {
    Vector6d efforts = torques(to_natural.transformed(motion));
    for (int k = 0; k < motor_count; ++k) efforts(k) *= to_natural.effort(k);
    return efforts;
  };
  return out;
}

/// Explains a solver's answers like a file's, and lets it be asked further if there is time.
void explainSolver(const Scenario& scenario, const Evidence& evidence, const Subject& subject,
                   ValidationResult& result) {
  const GivenTorques answers = answersOf(evidence, subject.name);
  if (answers.t.empty() || partLikelyCause() == nullptr) return;
  const Subject solver = inSi(subject, evidence.natural);
  const TorqueFile file =
      within(torqueFileOf(answers, scenario.manipulator->motors()), scenario.trajectory->duration());
  const WrongSolver wrong{solver, subject, evidence, ""};
  partLikelyCause()(relocated(scenario, evidence.natural.origin), file, &wrong, result);
}

/// The subject, which answers only until the deadline, also when rebuilt.
Subject inTime(Subject subject, const Deadline& deadline) {
  subject.torques = [torques = std::move(subject.torques), deadline](const Motion<double>& motion) {
    deadline.require();
    return torques(motion);
  };
  if (subject.rebuilt)
    subject.rebuilt = [rebuilt = std::move(subject.rebuilt), deadline](const Manipulator& machine) {
      return inTime(rebuilt(machine), deadline);
    };
  return subject;
}

ValidationResult run(const Scenario& scenario, const Reference& reference, const Subject& given, bool right,
                     const ValidationOptions& options) {
  requireTellingTolerance(scenario);
  const bool keeps_nothing = given.formulation == Formulation::external && !given.answers;
  const Subject subject = inTime(keeps_nothing ? recorded(given) : given, reference.deadline);
  if (!options.quick) reference.prepare(static_cast<bool>(subject.accelerations), options.ladder);
  const WorkParts work = workParts(scenario);
  double done = work.reference;
  reportProgress(options, work, done, "experiments");
  Evidence evidence = gather(scenario, reference, subject, right, options.fault ? *options.fault : InjectedFault{},
                             {options.ladder, options.reactions, options.quick, witnesses(), [&](double share) {
                                reportProgress(options, work, done + share * work.samples, "experiments");
                              }});
  ValidationResult result = emptyResult(scenario, subject);
  done += work.samples + work.replays;
  reportProgress(options, work, done, "checks");
  if (right && options.time_limit <= 0 && !options.asked_to_end) evidence.threads = options.threads;
  result.checks = judgeAll(evidence);
  done += work.checks;
  reportProgress(options, work, done, "sources of the error");
  std::optional<ErrorBudget> budget;
  if (options.budget && evidence.amplification != nullptr)
    budget = attribute(*evidence.scenario, evidence.samples, evidence.windows, evidence.amplification, evidence.plan,
                       options.threads);
  reference.stop();  // the rest is short and turns the finished part into a result
  judgeEveryAnswer(evidence, result.checks);
  addFacts(budget, evidence, result);
  addQuestions(evidence, result);
  result.deviation = effortDeviation(evidence, result.checks, result.odd_one);
  conclude(scenario, evidence.has, 0, result);
  if (result.verdict == Verdict::fail && subject.formulation == Formulation::external && !onlyOddEngineFails(result)) {
    explainSolver(scenario, evidence, subject, result);
    result.size = failureSize(*evidence.scenario, evidence.samples, scenario, evidence.natural, result);
  }
  addEffortWords(result);
  return result;
}

std::shared_ptr<const Reference> referenceOf(const Scenario& scenario, const ValidationOptions& options) {
  if (options.progress) options.progress(0, "the right motion");
  const Deadline deadline(options.time_limit, options.asked_to_end);
  const FormulationFaults faults = options.fault ? options.fault->formulations : FormulationFaults{};
  if (faults) return std::make_shared<const Reference>(scenario, options.threads, deadline, faults);
  if (options.quick && !options.reference)
    return std::make_shared<const Reference>(scenario, options.threads, deadline, faults, false);
  return options.reference ? options.reference : makeReference(scenario, options.threads, deadline);
}

/// Returns a report even if time ran out before any experiment.
ValidationResult nothingReached(const Scenario& scenario, const Subject& subject, const OutOfTime& over) {
  ValidationResult result = emptyResult(scenario, subject);
  SubjectHas has(subject);
  has.out_of_time = over.what();
  conclude(scenario, has, 0, result);
  addEffortWords(result);
  return result;
}

ValidationResult validateOwn(const Scenario& scenario, const SubjectOf& make, bool right,
                             const ValidationOptions& options) {
  try {
    const std::shared_ptr<const Reference> reference = referenceOf(scenario, options);
    const Subject subject = transformed(make(reference->relocated), reference->natural.unshifted());
    return run(scenario, *reference, subject, right, options);
  } catch (const OutOfTime& over) {
    return nothingReached(scenario, make(scenario), over);
  }
}

}  // namespace

std::shared_ptr<const Reference> makeReference(const Scenario& scenario, int threads, const Deadline& deadline) {
  return std::make_shared<const Reference>(scenario, threads, deadline);
}

ValidationResult validate(const Scenario& scenario, const Subject& subject, const ValidationOptions& options) {
  try {
    const std::shared_ptr<const Reference> reference = referenceOf(scenario, options);
    return run(scenario, *reference, transformed(subject, reference->natural), false, options);
  } catch (const OutOfTime& over) {
    return nothingReached(scenario, subject, over);
  }
}

ValidationResult validateMade(const Scenario& scenario, const SubjectOf& make, const ValidationOptions& options) {
  return validateOwn(scenario, make, false, options);
}

ValidationResult validate(const Scenario& scenario, const ValidationOptions& options) {
  const SubjectOf noc = [](const Scenario& its) { return nocSubject(*its.manipulator, its.load); };
  return validateOwn(scenario, noc, true, options);
}

void setTolerance(const EffortTolerance& users, Scenario& scenario) { setTolerance(users, scenario.tolerance); }

void setTolerance(const EffortTolerance& users, std::optional<EffortTolerance>& tolerance) {
  if (users.relative > 0 || users.absolute > 0) tolerance = users;
  if (tolerance) tolerance->any = users.any;
}

double estimatedSeconds(const Scenario& scenario) {
  requireWhole(scenario);
  return workSeconds(scenario);
}

}  // namespace ursula
