#include "report/motors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ursula::report {
namespace {

constexpr double may_remain = 0.01;  // as in the diagnosis: below it the deviation counts as explained

bool areWrong(const ValidationResult& result) {
  return std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.verdict == Verdict::fail && check.name.rfind("torque.", 0) == 0;
  });
}

/// Least squares; both sums use the instants that have both efforts.
MotorDeviation deviationOf(int motor, const std::vector<double>& t, const std::vector<double>& given,
                           const std::vector<double>& expected) {
  MotorDeviation out;
  out.motor = motor;
  double off_expected = 0, expected_squared = 0, sum = 0, squared = 0, count = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double off = given[k] - expected[k];
    if (!std::isfinite(off)) continue;
    if (count++ == 0 || std::abs(off) > out.largest) out.largest = std::abs(off), out.t = t[k];
    off_expected += off * expected[k];
    expected_squared += expected[k] * expected[k];
    sum += off;
    squared += off * off;
  }
  // The remainder of the squared deviation after a fit of one number.
  const double may_be_left = may_remain * may_remain * squared;
  if (squared > 0 && squared - off_expected * off_expected / expected_squared <= may_be_left)
    out.factor = 1 + off_expected / expected_squared;
  if (squared > 0 && squared - sum * sum / count <= may_be_left) out.offset = sum / count;
  return out;
}

}  // namespace

std::vector<MotorDeviation> motorsOff(const ValidationResult& result) {
  std::vector<MotorDeviation> out;
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (t == nullptr || !areWrong(result)) return out;
  for (int motor = 0;; ++motor)
    for (const char* unit : {"Nm", "N", ""}) {
      if (*unit == '\0') return out;
      const std::vector<double>* given = result.timeseries.find(fmt::format("tau_{}_{}", motor + 1, unit));
      const std::vector<double>* expected = result.timeseries.find(fmt::format("simbody_tau_{}_{}", motor + 1, unit));
      if (given == nullptr || expected == nullptr) continue;
      out.push_back(deviationOf(motor, *t, *given, *expected));
      out.back().unit = unit;
      break;
    }
}

}  // namespace ursula::report
