#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "parts/identify/identify.h"
#include "report/text/text.h"

namespace ursula {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const LogFinding& finding) {
  Json out = {{"kind", finding.kind}, {"value", finding.value}, {"unit", finding.unit}, {"what", finding.what}};
  if (finding.channel >= 0) out["motor"] = finding.channel + 1;
  return out;
}

Json jsonOf(const MeasuredCause& cause) {
  Json out = {{"kind", cause.kind}, {"what", cause.what}};
  if (!cause.parameter.empty()) out["parameter"] = cause.parameter;
  if (cause.motor > 0) out["motor"] = cause.motor;
  out["expected"] = cause.expected;
  out["found"] = cause.found;
  out["uncertainty"] = cause.uncertainty;
  out["unit"] = cause.unit;
  if (cause.tolerances != 0) out["tolerances"] = cause.tolerances;
  out["score"] = cause.score;
  out["explained"] = cause.explained;
  out["outside_parameters"] = cause.outside;
  if (!cause.as_well.empty()) out["as_well"] = cause.as_well;
  return out;
}

Json jsonOf(const MeasuredNumber& number) {
  Json out = {{"name", number.name},
              {"group", number.group},
              {"unit", number.unit},
              {"nominal", number.nominal},
              {"value", number.value},
              {"standard_uncertainty", number.uncertainty},
              {"interval_95", {number.low, number.high}}};
  if (number.tolerance >= 0) out["tolerance"] = number.tolerance;
  if (number.least_found > 0) out["least_deviation_found"] = number.least_found;
  if (!number.terms.empty()) {
    out["terms"] = Json::array();
    for (const auto& [name, factor] : number.terms) out["terms"].push_back({{"number", name}, {"factor", factor}});
  } else {
    out["identified"] = number.identified;
  }
  return out;
}

Json jsonOf(const MotorAgreement& motor) {
  Json out = {{"unit", motor.unit},
              {"effort_rms", motor.effort},
              {"E_rms", motor.deviation},
              {"E_largest", motor.largest},
              {"E_largest_at_s", motor.largest_at_s},
              {"u_num", motor.u_num},
              {"u_input", motor.u_input},
              {"u_D", motor.u_D},
              {"u_val", motor.u_val},
              {"within_95", motor.within},
              {"sample_noise", motor.noise},
              {"fitted_residual_rms", motor.left}};
  out["expected_residual_rms"] = motor.expected > 0 ? Json(motor.expected) : Json();
  return out;
}

template <class Items>
Json listOf(const Items& items) {
  Json out = Json::array();
  for (const auto& each : items) out.push_back(jsonOf(each));
  return out;
}

std::string causeLine(const MeasuredCause& cause) {
  if (cause.score == 0) return cause.what;
  const std::string unit = cause.unit.empty() ? "" : " " + cause.unit;
  std::string out =
      fmt::format("{} {:.6g} ± {:.2g}{} instead of {:.6g}{}", cause.parameter.empty() ? cause.what : cause.parameter,
                  cause.found, 1.96 * cause.uncertainty, unit, cause.expected, unit);
  if (cause.tolerances != 0) out += fmt::format(" ({:+.3g} tolerances)", cause.tolerances);
  return cause.outside ? out + ", outside of masses, inertias and friction" : out;
}

}  // namespace

std::string identifySummary(const IdentifyResult& result) {
  Json out = {{"scenario", result.scenario.name},
              {"log", result.file},
              {"verdict", name(result.verdict)},
              {"sentence", result.sentence}};
  out["cause"] = result.causes.empty() ? Json() : jsonOf(result.causes.front());
  out["causes"] = listOf(result.causes);
  out["findings"] = listOf(result.findings);
  out["read_as"] = result.read_as;
  out["ignored"] = result.ignored;
  out["log_rows"] = result.rows;
  out["step_s"] = result.step;
  out["duration_s"] = result.duration;
  out["periods"] = result.periods;
  out["filter"] = {{"motion_bandwidth_Hz", result.bandwidth},
                   {"motion_cutoff_Hz", result.state_cut},
                   {"effort_cutoff_Hz", result.effort_cut},
                   {"instants", result.instants}};
  out["delay"] = {{"value_s", result.delay},
                  {"standard_uncertainty_s", result.delay_uncertainty},
                  {"interval_95_s",
                   {result.delay - 1.96 * result.delay_uncertainty, result.delay + 1.96 * result.delay_uncertainty}},
                  {"value_samples", result.step > 0 ? result.delay / result.step : 0},
                  {"standard_uncertainty_samples", result.step > 0 ? result.delay_uncertainty / result.step : 0}};
  out["validation"] = {
      {"deviation_squares", result.squares}, {"limit", result.squares_limit}, {"score_threshold", result.threshold}};
  out["motors"] = listOf(result.motors);
  out["cross_validation"] = {{"from_s", result.validation_from_s},
                             {"given_over_noise", result.validation_given},
                             {"fitted_over_noise", result.validation_fitted}};
  out["combinations"] = listOf(result.combinations);
  out["parameters"] = listOf(result.numbers);
  out["not_seen"] = result.unseen;
  out["version"] = result.version;
  return jsonText(out, 2) + "\n";
}

std::string identifyTable(const IdentifyResult& result) {
  std::string out = "kind,name,group,unit,nominal,value,standard_uncertainty,low_95,high_95,tolerance,identified\n";
  const auto add = [&out](const char* kind, const MeasuredNumber& n) {
    out += fmt::format("{},\"{}\",{},{},{},{},{},{},{},{},{}\n", kind, n.name, n.group, n.unit, n.nominal, n.value,
                       n.uncertainty, n.low, n.high, n.tolerance >= 0 ? fmt::format("{}", n.tolerance) : "",
                       n.identified ? 1 : 0);
  };
  for (const MeasuredNumber& each : result.combinations) add("combination", each);
  for (const MeasuredNumber& each : result.numbers) add("parameter", each);
  return out;
}

std::string identifyText(const IdentifyResult& result) {
  std::string out = fmt::format("{}: {}\n", name(result.verdict), result.sentence);
  for (const LogFinding& finding : result.findings) out += fmt::format("  {}: {}\n", finding.kind, finding.what);
  for (const MeasuredCause& cause : result.causes) out += fmt::format("  cause: {}\n", causeLine(cause));
  if (result.series.names.empty()) return out;
  out += fmt::format(
      "  delay of the efforts {:.4g} ± {:.2g} samples ({:.4g} s); low passes at {:.3g} and {:.3g} Hz; {} instants\n",
      result.delay / result.step, 1.96 * result.delay_uncertainty / result.step, result.delay, result.state_cut,
      result.effort_cut, result.instants);
  std::vector<std::vector<std::string>> rows = {
      {"  motor", "effort", "E", "u_num", "u_input", "u_D", "u_val", "within", "fitted", "noise"}};
  const auto cell = [](double x) { return fmt::format("{:.3g}", x); };
  for (std::size_t k = 0; k < result.motors.size(); ++k) {
    const MotorAgreement& m = result.motors[k];
    rows.push_back({fmt::format("  {} ({})", k + 1, m.unit), cell(m.effort), cell(m.deviation), cell(m.u_num),
                    cell(m.u_input), cell(m.u_D), cell(m.u_val), fmt::format("{:.1f} %", 100 * m.within), cell(m.left),
                    cell(m.expected)});
  }
  std::vector<report::Align> columns(rows.front().size(), report::Align::right);
  columns.front() = report::Align::left;
  for (const std::string& line : report::alignedRows(rows, columns)) out += line + "\n";
  const auto identified =
      std::count_if(result.numbers.begin(), result.numbers.end(), [](const MeasuredNumber& n) { return n.identified; });
  return out + fmt::format(
                   "  {} combinations of numbers shown, {} numbers by themselves; on the part not fitted: given "
                   "{:.3g}, fitted {:.3g} of the noise\n",
                   result.combinations.size(), identified, result.validation_given, result.validation_fitted);
}

}  // namespace ursula
