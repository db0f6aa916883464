#include "validation/checks/tolerance.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/instants.h"
#include "validation/checks/judges.h"
#include "validation/verdict/effort_words.h"
#include "validation/verdict/worst_share.h"

namespace ursula {

/// A limit decides only if there is a finished value to compare with.
void judgeByUser(double limit, const std::string& whose, Check& check) {
  const bool finished = check.reason == Reason::none || check.reason == Reason::limit_useless;
  if (!finished) {
    check.why += fmt::format("; {} allows {:.3g} {}, but there is no finished value to compare with it", whose, limit,
                             check.unit);
    return;
  }
  const bool wider = !(limit <= check.limit) || check.reason == Reason::limit_useless;
  const Largest largest = check.largest;
  const std::string where = largest.where.empty() ? "" : ", " + largest.where;
  check = judged(check.name, largest.value, limit, check.unit,
                 fmt::format("{}; derived: {:.3g}, {}", whose, check.limit, check.basis),
                 fmt::format("{}; the largest value, at t = {:.6g} s{}", check.why, largest.t, where));
  check.largest = largest;
  check.limit_by = wider ? LimitBy::user : LimitBy::derived;
}

void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result) {
  for (const AcceptanceLimit& wanted : acceptance) {
    const auto found = std::find_if(result.checks.begin(), result.checks.end(),
                                    [&wanted](const Check& check) { return check.name == wanted.check; });
    if (found == result.checks.end())
      result.checks.push_back(notMade(wanted.check, "", "[acceptance] names a check that is none"));
    else if (found->verdict != Verdict::not_applicable)
      judgeByUser(wanted.limit, "[acceptance] of the scenario", *found);
  }
  for (const Check& check : result.checks)
    if (check.limit_by == LimitBy::user) result.limits = LimitBy::user;
  result.verdict = overall(result.checks);
}

namespace {

bool isOfTorques(const Check& check) { return isOf(check, "torque") && check.verdict != Verdict::not_applicable; }

/// Whether the check shows effects of torque errors on the motion, or only how torques are computed.
bool isReported(const Check& check) {
  for (const char* group : {"acceleration", "replay", "closure", "energy", "feedback", "invariance"})
    if (isOf(check, group)) return true;
  return check.name == "integration.ladder" || check.name == "integration.second";
}

bool isNamed(const std::vector<AcceptanceLimit>& acceptance, const std::string& check) {
  return std::any_of(acceptance.begin(), acceptance.end(),
                     [&check](const AcceptanceLimit& limit) { return limit.check == check; });
}

/// The drift from errors of `size` on the motors in the worst direction along the motion, in natural units.
double driftOf(const Evidence& evidence, double size) {
  if (evidence.amplification == nullptr || evidence.samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<PointwiseSample>& samples = evidence.samples;
  return evidence.amplification->carriedBound(0, evidence.scenario->trajectory->duration(), [&](double t) {
    return samples[indexFrom(samples, t)].conditioning.response * size;
  });
}

/// The longest time between two samples, s.
double widestGap(const Evidence& evidence) {
  double gap = 0;
  for (std::size_t k = 1; k < evidence.samples.size(); ++k)
    gap = std::max(gap, evidence.samples[k].motion.t - evidence.samples[k - 1].motion.t);
  return gap * evidence.units().time;
}

/// The largest effort of the whole motion, in the scenario's units; it is the same for all subjects and instants.
double largestEffort(const Scenario& scenario) {
  constexpr int instants = 2001;
  const Subject right = nocSubject(*scenario.manipulator, scenario.load);
  double largest = 0;
  for (const double t : equallySpaced(scenario.trajectory->duration(), instants))
    largest = std::max(largest, right.torques(scenario.trajectory->at(t)).cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace

void takeLargest(const Check& check, bool& any, EffortDeviation& out) {
  if (!std::isnan(check.missed) && !(out.seen <= check.missed)) out.seen = check.missed;
  if (any && !exceeds(check.largest.value, out.largest)) return;
  out.largest = check.largest.value;
  out.t = check.largest.t;
  out.where = check.largest.where;
  any = true;
}

void takeBetween(const std::vector<Check>& checks, EffortDeviation& out) {
  // Two numbers of one check: what torque.between sees, it sees between the samples.
  if (const Check* between = findCheck(checks, "torque.between"); between != nullptr && std::isfinite(between->gap))
    out.seen = between->missed, out.seen_for = between->gap;
}

std::optional<EffortDeviation> effortDeviation(const Evidence& evidence, const std::vector<Check>& checks,
                                               const OddOne& odd_one) {
  const Units& units = evidence.units();
  EffortDeviation out;
  bool any = false;
  for (const Check& check : checks) {
    if (!isOfTorques(check) || check.reason == Reason::not_made) continue;
    if (check.verdict == Verdict::inconclusive && std::isnan(check.largest.value)) continue;  // nothing was compared
    if (isOfEngine(check, odd_one.engine())) {
      out.without = odd_one.engine();
      out.from_without = larger(out.from_without, check.largest.value);
      continue;
    }
    takeLargest(check, any, out);
  }
  if (evidence.external == nullptr) out.seen_for = widestGap(evidence);
  takeBetween(checks, out);
  if (!any || evidence.samples.empty() || !evidence.answered()) return std::nullopt;
  out.unit = units.efforts.unit;
  out.largest_effort = largestEffort(*evidence.scenario) * units.effort();
  out.length = evidence.samples.front().conditioning.length * units.length;
  out.drift = driftOf(evidence, out.largest / units.effort()) * units.length;
  out.duration = evidence.given->trajectory->duration();
  return out;
}

void requireTellingTolerance(const EffortTolerance& tolerance, const std::string& scenario, const std::string& noun,
                             const std::string& unit, double largest) {
  const double allowed = tolerance.relative * largest + tolerance.absolute;
  if (tolerance.any || !(largest > 0) || allowed < largest) return;
  throw ScenarioError(
      fmt::format("{}: error: at a tolerance of {:.6g} {} {}s of zero would pass, because the largest {} of the "
                  "motion is {:.6g} {}; expected a smaller one, or --any-tolerance to accept it",
                  scenario, allowed, unit, noun, noun, largest, unit));
}

void requireTellingTolerance(const Scenario& scenario) {
  if (scenario.tolerance && !scenario.tolerance->any)
    requireTellingTolerance(*scenario.tolerance, scenario.name, effortNoun(scenario.manipulator->motors()),
                            effortsOf(*scenario.manipulator).unit, largestEffort(scenario));
}

void judgeByTolerance(const std::optional<EffortTolerance>& given, const std::vector<AcceptanceLimit>& acceptance,
                      double between, ValidationResult& result) {
  if (!given || !result.deviation) return;  // nothing was compared: the checks say why
  const EffortTolerance& tolerance = *given;
  EffortDeviation& deviation = *result.deviation;
  deviation.allowed = tolerance.relative * deviation.largest_effort + tolerance.absolute;
  if (deviation.largest_effort > 0) deviation.seen = deviation.allowed / deviation.largest_effort;
  const std::string& unit = deviation.unit;
  const std::string whose = fmt::format("the user's tolerance, {:g} of the largest effort, {:.6g} {}, and {:g} {}",
                                        tolerance.relative, deviation.largest_effort, unit, tolerance.absolute, unit);
  for (Check& check : result.checks) {
    if (isOfTorques(check)) judgeByUser(deviation.allowed, whose, check);
    if (!isReported(check) || check.verdict == Verdict::not_applicable) continue;
    if (isNamed(acceptance, check.name) || (check.reason == Reason::not_covered && !(between <= deviation.allowed)))
      continue;
    check.verdict = Verdict::not_applicable;
    check.reason = Reason::reported;
    check.why = "reported, not judged: where a tolerance is given, only the torques are judged. " + check.why;
  }
}

void conclude(const Scenario& scenario, const SubjectHas& has, double between, ValidationResult& result) {
  listEveryCheck(scenario, has, result);
  judgeByTolerance(scenario.tolerance, scenario.acceptance, between, result);
  judgeByUser(scenario.acceptance, result);
}

}  // namespace ursula
