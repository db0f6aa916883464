#include "validation/validate.h"

#include <algorithm>

#include "model/instants.h"
#include "validation/checks/families.h"
#include "validation/checks/judges.h"
#include "validation/checks/tolerance.h"
#include "validation/findings/findings.h"
#include "validation/subject/motion_check.h"
#include "validation/verdict/effort_words.h"

namespace ursula {
namespace {

bool anyNotPassed(const std::vector<Check>& checks) {
  return anyIs(checks, Verdict::fail) || anyIs(checks, Verdict::inconclusive);
}

/// Compares everything at an instant with measured limits unless all pass with derived ones.
std::vector<Check> judgeSamples(Evidence& evidence) {
  const int count = evidence.given->simulation.samples;
  const std::vector<double> instants = equallySpaced(evidence.scenario->trajectory->duration(), count);
  evidence.samples = runJointsAndTorques(*evidence.scenario, *evidence.subject, instants);
  std::vector<Check> checks =
      judgeJointsAndTorques(evidence.samples, evidence.units(), MotionSizes(*evidence.scenario));
  if (anyNotPassed(checks)) {
    const RoundingProfile profile(*evidence.scenario, profileInstants(count));
    evidence.samples = runPointwise(*evidence.scenario, *evidence.subject, instants, profile);
    checks = judgePointwise(evidence.samples, true, evidence.units(), profile.sizes());
  }
  checksInSi(evidence.units(), checks);
  return checks;
}

}  // namespace

ValidationResult validatePointwise(const Scenario& given, const std::vector<Check>* of_motion) {
  checkMotion(given);
  requireTellingTolerance(given);
  Evidence evidence;
  evidence.given = &given;
  evidence.natural = naturalFrameChange(given);
  const Scenario scenario = evidence.natural.transformed(given);
  const Scenario near_origin = relocated(given, evidence.natural.origin);
  const Subject subject =
      transformed(nocSubject(*near_origin.manipulator, near_origin.load), evidence.natural.unshifted());
  evidence.scenario = &scenario;
  evidence.subject = &subject;
  evidence.has.left_out_replays = true;

  ValidationResult result = emptyResult(given, subject);
  result.checks = of_motion == nullptr ? judgeCommandedMotion(given) : *of_motion;
  for (Check& check : judgeSamples(evidence)) result.checks.push_back(std::move(check));
  if (given.tolerance) result.deviation = effortDeviation(evidence, result.checks);
  conclude(given, evidence.has, 0, result);
  addEffortWords(result);
  return result;
}

}  // namespace ursula
