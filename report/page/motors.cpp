#include "report/page/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/html_template.h"
#include "report/text/mechanism_words.h"
#include "report/text/quantity.h"
#include "report/text/text.h"
#include "validation/verdict/worst_share.h"

namespace ursula::report {

extern const std::string_view motors_html;  // of web/

namespace {

constexpr double may_remain = 0.01;  // share of a deviation that an explanation may leave, as in the diagnosis

bool areWrong(const ValidationResult& result) {
  return !onlyOddEngineFails(result) && std::any_of(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.verdict == Verdict::fail && isOf(check, "torque");
  });
}

/// Fits a factor or an offset by least squares, over the instants that have both efforts.
MotorDeviation deviationOf(int motor, const std::vector<double>& t, const std::vector<double>& given,
                           const std::vector<double>& expected) {
  MotorDeviation out;
  out.motor = motor;
  double off_expected = 0, expected_squared = 0, sum = 0, squared = 0, count = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double off = given[k] - expected[k];
    if (k == 0 || exceeds(std::abs(off), out.largest))
      out.largest = std::abs(off), out.t = t[k], out.given = given[k], out.expected = expected[k];
    if (!std::isfinite(off)) continue;
    ++count;
    off_expected += off * expected[k];
    expected_squared += expected[k] * expected[k];
    sum += off;
    squared += off * off;
  }
  // One number is fitted, and this much of the squared deviation may remain.
  const double may_be_left = may_remain * may_remain * squared;
  if (squared > 0 && squared - off_expected * off_expected / expected_squared <= may_be_left)
    out.factor = 1 + off_expected / expected_squared;
  if (squared > 0 && squared - sum * sum / count <= may_be_left) out.offset = sum / count;
  return out;
}

/// Returns whether the deviation is within its limit at every instant. A limit of all motors exists if they have one
/// unit.
bool isRightThroughout(const ValidationResult& result, int motor, const std::string& unit,
                       const std::vector<double>& given, const std::vector<double>& expected) {
  const std::vector<double>* limit = result.timeseries.find(fmt::format("limit_tau_{}_{}", motor + 1, unit));
  if (limit == nullptr) limit = result.timeseries.find("limit_tau_" + unit);
  if (limit == nullptr) return false;
  for (std::size_t k = 0; k < limit->size(); ++k)
    if (!(std::abs(given[k] - expected[k]) <= (*limit)[k])) return false;
  return true;
}

/// Sets the shares of the largest expected effort of any motor with the same unit.
void addShares(const ValidationResult& result, std::vector<MotorDeviation>& motors) {
  for (MotorDeviation& motor : motors) {
    double largest = 0;
    for (const MotorDeviation& other : motors) {
      if (other.unit != motor.unit) continue;
      for (const double each : *result.timeseries.find(fmt::format("simbody_tau_{}_{}", other.motor + 1, other.unit)))
        if (std::isfinite(each)) largest = std::max(largest, std::abs(each));
    }
    const auto& whole = result.deviation;  // a file may cover a part of the motion
    if (whole && prettyUnit(whole->unit) == prettyUnit(motor.unit)) largest = std::max(largest, whole->largest_effort);
    if (largest > 0) motor.share = motor.largest / largest;
  }
}

/// Returns "1.003 × expected" or "expected + 3 N"; empty if no single number explains the deviation.
std::string patternText(const MotorDeviation& motor) {
  if (motor.right) return "";
  if (motor.factor) return factorText(*motor.factor) + " × expected";
  if (!motor.offset) return "";
  return fmt::format("expected {} {:.6g} {}", *motor.offset < 0 ? "−" : "+", std::abs(*motor.offset),
                     prettyUnit(motor.unit));
}

HtmlValue motorRow(const MotorDeviation& motor, const std::vector<std::string>& names) {
  const auto [given, expected] = toldApart(motor);
  return {{"motor", motorName(names, static_cast<std::size_t>(motor.motor))},
          {"given", unbroken(given)},
          {"expected", unbroken(expected)},
          {"right", motor.right},
          {"largest", quantity(motor.largest, motor.unit)},
          {"at", fmt::format("{:.4g} s", motor.t)},
          {"pattern", patternText(motor)}};
}

}  // namespace

std::string factorText(double factor) {
  const double off = factor - 1;
  if (off == 0 || std::abs(off) >= 1e-4) return fmt::format("{:.6g}", factor);
  return fmt::format("(1 {} {})", off < 0 ? "−" : "+", plainNumber(std::abs(off)));
}

std::string motorsTable(const ValidationResult& result) {
  const std::vector<MotorDeviation> motors = motorsOff(result);
  if (motors.empty()) return "";
  // A factor that fits only one of many motors is a coincidence.
  const bool patterns = std::all_of(motors.begin(), motors.end(), [](const MotorDeviation& motor) {
    return motor.right || !patternText(motor).empty();
  });
  const std::vector<std::string> names = motorNames(result);
  const auto row = [&names](const MotorDeviation& motor) { return motorRow(motor, names); };
  return rendered(motors_html, {{"patterns", patterns},
                                {"named", !names.empty()},
                                {"columns", patterns ? 5 : 4},
                                {"motors", listOf(motors, row)}});
}

std::optional<MotorDeviation> worstOf(const std::vector<MotorDeviation>& motors) {
  std::optional<MotorDeviation> worst;
  for (const MotorDeviation& motor : motors)
    if (!motor.right && (!worst || exceeds(motor.share, worst->share))) worst = motor;
  return worst;
}

std::vector<int> markedOf(const std::vector<MotorDeviation>& motors) {
  std::vector<int> out;
  for (const MotorDeviation& motor : motors)
    if (!motor.right) out.push_back(motor.motor);
  if (out.size() > 1 && out.size() == motors.size()) out = {worstOf(motors)->motor};
  return out;
}

std::vector<MotorDeviation> motorsOff(const ValidationResult& result) {
  std::vector<MotorDeviation> out;
  const std::vector<double>* t = result.timeseries.find("t_s");
  if (t == nullptr || !areWrong(result)) return out;
  for (int motor = 0;; ++motor)
    for (const char* unit : {"Nm", "N", ""}) {
      if (*unit == '\0') {
        addShares(result, out);
        return out;
      }
      const std::vector<double>* given = result.timeseries.find(fmt::format("tau_{}_{}", motor + 1, unit));
      const std::vector<double>* expected = result.timeseries.find(fmt::format("simbody_tau_{}_{}", motor + 1, unit));
      if (given == nullptr || expected == nullptr) continue;
      out.push_back(deviationOf(motor, *t, *given, *expected));
      out.back().unit = unit;
      out.back().right = isRightThroughout(result, motor, unit, *given, *expected);
      break;
    }
}

}  // namespace ursula::report
