// Reports an error's sources as findings: numbers in SI, a curve, lines of the report.

#include <algorithm>

#include "validation/findings/attribution.h"

namespace ursula {
namespace {

const std::string torques = "torques";

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

Curve curveOf(const ErrorBudget& budget, const Units& units, ErrorSource rest, const std::string& model) {
  const auto inSi = [](std::vector<double> values, double unit) {
    for (double& value : values) value *= unit;
    return values;
  };
  Curve out = {Curve::About::sources, "Sources of the replay's error", "t", true,
               inSi(budget.along.front(), units.time)};
  const std::string labels[] = {"observed", "rounding", "integration", "loop closure", model, name(rest), "limit"};
  for (std::size_t k = 0; k < std::size(labels); ++k)
    out.lines.push_back({labels[k], "m", inSi(budget.along[k + 1], units.length)});
  out.lines.front().role = CurveLine::Role::observed;
  out.lines.back().role = CurveLine::Role::limit;
  return out;
}

void addSources(const ReplayError& found, ErrorSource rest, const std::string& model, ValidationResult& result) {
  const auto add = [&result](const std::string& what, const SourceOfError& source) {
    result.findings.push_back({what, "", source.error, source.uncertainty, "m"});
  };
  result.findings.push_back({"replay, error in position", "", found.observed, std::nan(""), "m", found.t});
  add("of it by rounding", found.rounding);
  add("of it by the integration", found.integration);
  add("of it by the loops' gaps", found.closure);
  add((model == torques ? "of it by the " : "of it by ") + model, found.model);
  add(std::string("of it ") + name(rest), {found.unexplained, found.uncertainty});
  result.findings.push_back({"amplification of a deviation at the start", "", found.amplification});
}

}  // namespace

void addBudget(const ErrorBudget& budget, ValidationResult& result, const Units& units, ErrorSource rest) {
  const bool limit_too_large = std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.reason == Reason::limit_useless && isOf(check, "replay");
  });
  // Torque errors between the samples leave no residual at them, so the error seems to have another source.
  const std::string odd_engine = result.odd_one.engine();
  const std::string model = onlyOddEngineFails(result) ? odd_engine : torques;
  const bool torques_fail = std::any_of(result.checks.begin(), result.checks.end(), [&odd_engine](const Check& check) {
    return check.verdict == Verdict::fail && check.reason == Reason::none && isOf(check, "torque") &&
           !isOfEngine(check, odd_engine);
  });
  if (!budget.measured && !anyIs(result.checks, Verdict::fail) && !limit_too_large)
    return;  // there is no error to have a source
  const ErrorSource dominant = torques_fail      ? ErrorSource::model
                               : limit_too_large ? ErrorSource::amplification
                               : budget.measured ? budget.dominant
                                                 : ErrorSource::model;
  ReplayError found = replayErrorOf(budget, units);
  // Errors of wrong torques soon leave the range in which sources add up; then the torques are all that can be told.
  if (torques_fail && 2 * found.uncertainty > found.observed) found = {};
  found.dominant = dominant == ErrorSource::unexplained ? rest : dominant;
  result.findings.push_back({"dominant error", name(found.dominant)});
  if (found.measured) {
    result.curves.push_back(curveOf(budget, units, rest, model));
    addSources(found, rest, model, result);
  }
  result.replay_error = std::move(found);
}

}  // namespace ursula
