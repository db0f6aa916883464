#include "parts/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/real50.h"
#include "model/instants.h"
#include "nocsolver/noc/noc.h"
#include "parts/audit/effect.h"
#include "parts/audit/formula.h"
#include "parts/audit/remarks.h"

namespace ursula {
namespace audit {
namespace {

constexpr int torque_samples = 101;
constexpr double replay_tolerance = 1e-10;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<Formula> allFormulas(const Manipulator& manipulator) {
  std::vector<Formula> all;
  const auto add = [&all](std::vector<Formula> some) {
    for (Formula& formula : some) all.push_back(std::move(formula));
  };
  add(displacementFormulas());
  add(rateFormulas());
  add(accelerationFormulas());
  add(jacobianFormulas());
  add(dynamicsFormulas());
  add(complementFormulas(manipulator));
  add(bodyFormulas());
  add(appendixFormulas());
  // The sort is stable: equal numbers keep their order.
  const auto number = [](const Formula& formula) {
    const std::size_t digit = formula.equation.find_first_of("0123456789");
    return digit == std::string::npos ? 1000 : std::stoi(formula.equation.substr(digit));
  };
  std::stable_sort(all.begin(), all.end(), [&](const Formula& a, const Formula& b) { return number(a) < number(b); });
  return all;
}

/// Largest component of a − b; NaN if one is NaN, or if the sizes differ.
double mismatch(const Values& a, const Values& b) {
  if (a.size() != b.size() || a.empty()) return nan;
  S worst(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const S off = abs(S(a[k] - b[k]));
    if (!(off <= worst)) worst = off;
    if (isnan(worst)) return nan;
  }
  return worst.convert_to<double>();
}

void measure(const Formula& formula, const std::vector<ReferenceState>& states, AuditRow& row) {
  row.residual_printed = row.residual_holds = formula.truth ? 0 : nan;
  for (const ReferenceState& reference : states) {
    if (!formula.truth) break;
    const Values truth = formula.truth(reference);
    row.size = std::max(row.size, mismatch(truth, Values(truth.size(), S(0))));
    row.residual_printed =
        larger(row.residual_printed, formula.printed.side ? mismatch(formula.printed.side(reference), truth) : nan);
    row.residual_holds = larger(
        row.residual_holds, formula.holds.side ? mismatch(formula.holds.side(reference), truth) : row.residual_printed);
  }
}

AuditRow rowOf(const Formula& formula, const Scenario& scenario, const std::vector<ReferenceState>& states) {
  AuditRow row;
  row.kind = formula.misprint ? AuditRow::Kind::misprint
                              : (formula.holds.text.empty() ? AuditRow::Kind::holds : AuditRow::Kind::fails);
  row.equation = formula.equation;
  row.printed = formula.printed.text;
  row.holds = formula.holds.text;
  row.unit = formula.unit;
  row.note = formula.note;
  measure(formula, states, row);
  if (formula.errors.empty()) return row;
  WithFormulaErrors formula_errors;
  for (FormulaError formula_error : formula.errors) formula_errors.set(formula_error);
  row.effect =
      effectOf(scenario, torquesWith(scenario, formula_errors, formula.only_in_36), torque_samples, replay_tolerance);
  return row;
}

/// Sets every error of (37) at once, with and without the one that makes the legs too short, and none as a control.
std::vector<AuditRow> allTogether(const Scenario& scenario, const std::vector<Formula>& formulas) {
  std::vector<AuditRow> rows;
  for (const bool with_5 : {true, false}) {
    WithFormulaErrors formula_errors;
    for (const Formula& formula : formulas)
      for (FormulaError formula_error : formula.errors)
        if (!formula.only_in_36 && (with_5 || formula_error != FormulaError::eq5)) formula_errors.set(formula_error);
    AuditRow row;
    row.kind = AuditRow::Kind::fails;
    row.equation = with_5 ? "all together" : "all but (5)";
    row.effect = effectOf(scenario, torquesWith(scenario, formula_errors, false), torque_samples, replay_tolerance);
    rows.push_back(std::move(row));
  }
  AuditRow control;
  control.equation = "none";
  control.effect =
      effectOf(scenario, torquesWith(scenario, WithFormulaErrors(), false), torque_samples, replay_tolerance);
  rows.push_back(std::move(control));
  return rows;
}

void requireReach(const Scenario& scenario) {
  const Noc<double> solver(*scenario.manipulator);
  NocWorkspace<double> work;
  for (double t : equallySpaced(scenario.trajectory->duration(), torque_samples))
    solver.inverseDynamics(scenario.trajectory->at(t), work);
}

}  // namespace
}  // namespace audit

Audit runAudit(const Scenario& scenario) {
  audit::requireReach(scenario);
  Audit result;
  result.scenario = scenario.name;
  result.duration = scenario.trajectory->duration();
  result.torque_samples = audit::torque_samples;
  result.replay_tolerance = audit::replay_tolerance;
  result.largest_torque = audit::largestTorque(scenario, audit::torque_samples);
  const audit::ReferenceMechanism mechanism(*scenario.manipulator, *scenario.trajectory);
  std::vector<audit::ReferenceState> states;
  for (int k = 1; k < 8; ++k) {  // instants within the motion, so that no rate vanishes at all of them
    result.instants.push_back(result.duration * k / 8);
    states.push_back(mechanism.at(Real50(result.instants.back())));
  }
  const std::vector<audit::Formula> formulas = audit::allFormulas(*scenario.manipulator);
  for (const audit::Formula& formula : formulas) result.rows.push_back(audit::rowOf(formula, scenario, states));
  result.together = audit::allTogether(scenario, formulas);
  result.remarks = audit::remarks(scenario, mechanism, states);
  return result;
}

}  // namespace ursula
