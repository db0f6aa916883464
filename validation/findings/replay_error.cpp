// Reports an error's sources as findings: numbers in SI, a curve, lines of the report.

#include <algorithm>

#include "validation/findings/attribution.h"

namespace ursula {
namespace {

/// Converts to SI.
ReplayError replayErrorOf(const ErrorBudget& budget, const Units& units) {
  const auto source = [&units](const ErrorShare& share) {
    return SourceOfError{share.error.norm() * units.length, share.uncertainty * units.length};
  };
  ReplayError out;
  out.measured = budget.measured;
  out.t = budget.t * units.time;
  out.observed = budget.observed.norm() * units.length;
  out.rounding = source(budget.rounding);
  out.integration = source(budget.integration);
  out.closure = source(budget.closure);
  out.model = source(budget.model);
  out.unexplained = budget.unexplained().norm() * units.length;
  out.uncertainty = budget.uncertainty() * units.length;
  out.amplification = budget.amplification;
  return out;
}

void addSources(const ReplayError& found, const std::string& rest, ValidationResult& result) {
  const auto add = [&result](const std::string& what, const SourceOfError& source) {
    result.findings.push_back({what, "", source.error, source.uncertainty, "m"});
  };
  result.findings.push_back({"replay, error in position", "", found.observed, std::nan(""), "m", found.t});
  add("of it by rounding", found.rounding);
  add("of it by the integration", found.integration);
  add("of it by the loops' gaps", found.closure);
  add("of it by the torques", found.model);
  add("of it " + rest, {found.unexplained, found.uncertainty});
  result.findings.push_back({"amplification of a deviation at the start", "", found.amplification});
}

}  // namespace

void addBudget(const ErrorBudget& budget, ValidationResult& result, const Units& units, const std::string& rest) {
  const bool limit_too_large = std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.reason == Reason::limit_useless && check.name.rfind("replay.", 0) == 0;
  });
  // Torque errors between the samples leave no residual at them, so the error seems to have another source.
  const bool torques_fail = std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.verdict == Verdict::fail && check.reason == Reason::none && check.name.rfind("torque.", 0) == 0;
  });
  const bool something_fails = std::any_of(result.checks.begin(), result.checks.end(),
                                           [](const Check& check) { return check.verdict == Verdict::fail; });
  if (!budget.measured && !something_fails && !limit_too_large) return;  // there is no error to have a source
  const std::string dominant = torques_fail      ? "model"
                               : limit_too_large ? "amplification"
                               : budget.measured ? budget.dominant
                                                 : "model";
  ReplayError found = replayErrorOf(budget, units);
  // Errors of wrong torques soon leave the range in which sources add up; then the torques are all that can be told.
  if (torques_fail && 2 * found.uncertainty > found.observed) found = {};
  found.dominant = dominant == "unexplained" ? rest : dominant;
  result.findings.push_back({"dominant error", found.dominant});
  if (found.measured) {
    result.curves.emplace_back("Sources of the replay's error", budget.along);
    for (std::string& column : result.curves.back().second.names)
      if (column == "unexplained (m)") column = rest + " (m)";
    addSources(found, rest, result);
  }
  result.replay_error = std::move(found);
}

}  // namespace ursula
