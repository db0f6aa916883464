#include <fmt/format.h>

#include <algorithm>

#include "report/columns.h"
#include "studies/identify/identify.h"

namespace ursula {
namespace {

std::string causeLine(const MeasuredCause& cause) {
  if (cause.score == 0) return cause.what;
  std::string out =
      fmt::format("{} {:.6g} ± {:.2g} {} instead of {:.6g}", cause.parameter.empty() ? cause.what : cause.parameter,
                  cause.found, 1.96 * cause.uncertainty, cause.unit, cause.expected);
  if (cause.tolerances != 0) out += fmt::format(" ({:+.3g} tolerances)", cause.tolerances);
  return cause.outside ? out + ", outside of masses, inertias and friction" : out;
}

}  // namespace

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
