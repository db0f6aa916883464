#include "tests/report/page_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/output_file.h"
#include "model/scenario.h"
#include "parts/compare/compare_page.h"
#include "tests/report/report_samples.h"

namespace ursula::test {
namespace {

constexpr std::size_t long_rows = 60001;

std::vector<double> stretched(const std::vector<double>& from, bool is_time) {
  std::vector<double> values(long_rows);
  for (std::size_t i = 0; i < long_rows; ++i) {
    const double place = static_cast<double>(i) / (long_rows - 1) * static_cast<double>(from.size() - 1);
    const std::size_t before = std::min(static_cast<std::size_t>(place), from.size() - 2);
    const double share = place - static_cast<double>(before);
    values[i] = is_time ? 1e-3 * static_cast<double>(i)
                        : ((1 - share) * from[before] + share * from[before + 1]) *
                              (1 + 1e-3 * std::sin(0.7 * static_cast<double>(i)));
  }
  return values;
}

}  // namespace

ValidationResult longSample() {
  ValidationResult result = passedSample();
  result.scenario = "long";
  TimeSeries& series = result.timeseries;
  for (std::size_t k = 0; k < series.names.size(); ++k)
    series.columns[k] = stretched(series.columns[k], series.names[k] == "t_s");
  for (Curve& curve : result.curves) {
    if (!curve.over_time) continue;
    curve.x = stretched(curve.x, true);
    for (CurveLine& line : curve.lines) line.values = stretched(line.values, false);
  }
  result.asked = std::make_shared<const Scenario>(readScenario(std::string(URSULA_SCENARIOS) + "/helix-60s.toml"));
  for (Event& event : result.events) event.t *= 20;
  return result;
}

ValidationResult machineSample(const std::string& name) {
  ValidationResult result = passedSample();
  result.scenario = name;
  result.asked = std::make_shared<const Scenario>(readScenario(std::string(URSULA_SCENARIOS) + "/" + name + ".toml"));
  std::vector<double>& t = result.timeseries.columns.front();
  const double share = result.asked->trajectory->duration() / t.back();
  for (double& each : t) each *= share;
  for (Curve& curve : result.curves)
    for (double& each : curve.x) each *= curve.over_time ? share : 1;
  for (Event& event : result.events) event.t *= share;
  return result;
}

TimeSeries comparedSample() {
  TimeSeries series = passedSample().timeseries;
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    if (series.names[k] == "tau_3_Nm")
      for (double& value : series.columns[k]) value *= 1.001;
    if (series.names[k] == "closure_v_m_s") series.names[k] = "another_m_s";
  }
  return series;
}

ProveResult proveSample(bool weak) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  ProveResult found;
  found.scenario = "proving-ground";
  found.seed = 7;
  DefectProof proof;
  proof.outcomes = {{"Coriolis force left out", "formula", {"torque.pointwise", "torque.maximal"}, 2, true, ""},
                    {"mass of the platform × 1.001 <b>", "parameter", {"torque.pointwise"}, weak ? 2 : 1, true, ""},
                    {"friction of leg 3", "parameter", {}, 2, false, ""},
                    {"a link of no length", "machine", {}, 2, true, "length = 0, expected > 0"}};
  proof.checks = {{"torque.pointwise", {"mass of the platform × 1.001 <b>"}, {"Coriolis force left out"}},
                  {"torque.maximal", {"Coriolis force left out"}, {}}};
  found.proof = proof;
  found.sensitivities = {{"platform.mass", "mass", 1.2e-12, 3e-12}, {"leg.3.friction", "friction", infinite, 0}};
  found.random.runs = found.random.passed = 24;
  found.random.largest_share = {{"torque.pointwise", 0.031}};
  return found;
}

void writePageSamples(const std::filesystem::path& dir) {
  const TimeSeries reference = passedSample().timeseries;
  writeComparison(reference, comparedSample(), {}, {"passed", "<b>tested</b>"}, dir / "comparison");
  writeComparison(reference, reference, {}, {"passed", "passed"}, dir / "same");
  writeFileAtomically(dir / "prove.html", proveHtml(proveSample(false)));
  writeFileAtomically(dir / "weak.html", proveHtml(proveSample(true)));
}

}  // namespace ursula::test
