#include "validation/external/few_digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/leading_number.h"

namespace ursula {
namespace {

using Test = std::function<bool(std::size_t row, int motor)>;

bool holdsForAll(const ExternalTorques& torques, const Test& test) {
  for (std::size_t k = 0; k < torques.file.rows(); ++k)
    for (int i = 0; i < motor_count; ++i)
      if (!test(k, i)) return false;
  return torques.file.rows() > 0;
}

Explanation ofDigits(const std::string& text) {
  Explanation out{text, NamedCause{CauseKind::digits, "", "all"}};
  out.named->explained = 1;
  return out;
}

bool isSinglePrecision(const ExternalTorques& torques) {
  return torques.file.all_single && holdsForAll(torques, [&](std::size_t k, int i) {
           const double half = std::ldexp(std::abs(torques.noc[k](i)), -24);
           return std::abs(offAt(torques, k, i)) <= 2 * half + limitAt(torques, k, i);
         });
}

bool isPrinted(const std::string& text, double value) { return leadingNumber(text).value == value; }

/// Returns one unit of the last of `digits` significant digits.
double lastDigit(double value, int digits) {
  return value == 0 ? 0 : std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
}

/// Explains answers that a format of few digits reproduces, and that deviate by at most half of the last digit.
std::optional<Explanation> rounded(const MotorNames& motors, const ExternalTorques& torques) {
  constexpr int most = 12;
  const auto offBy = [&](std::size_t k, int i, double unit) {
    return std::abs(offAt(torques, k, i)) <= 0.5 * unit * (1 + 1e-9) + roundingAt(torques, k);
  };
  for (int digits = 1; digits <= most; ++digits) {
    const bool all = holdsForAll(torques, [&](std::size_t k, int i) {
      const double value = torques.file.torques[k](i);
      return isPrinted(fmt::format("{:.{}e}", value, digits - 1), value) && offBy(k, i, lastDigit(value, digits));
    });
    if (all) return ofDigits(fmt::format("few digits: every answer is rounded to {} significant ones", digits));
  }
  for (int places = 0; places <= most; ++places) {
    const double unit = std::pow(10.0, -places);
    const bool all = holdsForAll(torques, [&](std::size_t k, int i) {
      const double value = torques.file.torques[k](i);
      return isPrinted(fmt::format("{:.{}f}", value, places), value) && offBy(k, i, unit);
    });
    if (all) return ofDigits(fmt::format("few digits: every answer is rounded to {:g} {}", unit, motors.unit(0)));
  }
  return std::nullopt;
}

/// Explains deviations that are about as large as the jumps of answers to nearly the same question. The jumps must
/// exceed rounding in doubles.
std::optional<Explanation> grainy(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked) {
  constexpr double grains = 100, more_than_rounding = 100, least = 1e-10, most = 1e-4;
  double largest = 0, rounding = 0;
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    largest = std::max(largest, torques.noc[k].cwiseAbs().maxCoeff());
    rounding = std::max(rounding, roundingAt(torques, k));
  }
  if (!(asked.grain > std::max(least * largest, more_than_rounding * rounding) && asked.grain < most * largest))
    return std::nullopt;
  const bool all = holdsForAll(
      torques, [&](std::size_t k, int i) { return std::abs(offAt(torques, k, i)) <= grains * asked.grain; });
  if (!all) return std::nullopt;
  return ofDigits(
      fmt::format("single precision, or few digits, within the solver: answers to nearly the same question jump by "
                  "{:.2g} {}, {:.1g} "
                  "of the largest, and none is off by more than {:g} times that",
                  asked.grain, motors.unit(0), asked.grain / largest, grains));
}

}  // namespace

std::optional<Explanation> fewDigits(const MotorNames& motors, const ExternalTorques& torques,
                                     const AskedApart& asked) {
  if (isSinglePrecision(torques))
    return ofDigits("single precision: every torque is a 24-bit number, off by no more than such numbers are");
  if (asked.motions.empty()) return std::nullopt;  // a file's limits include its digits
  if (const auto found = rounded(motors, torques)) return found;
  return grainy(motors, torques, asked);
}

ExternalTorques inEveryDigit(ExternalTorques torques) {
  for (Vector6d& row : torques.precision) row.setZero();
  return torques;
}

}  // namespace ursula
