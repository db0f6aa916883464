#include "validation/causes/answers_alone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"

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

/// Explains answers that a format of few digits reproduces, and that deviate by at most half of the last digit, or by
/// less than one towards zero.
std::optional<Explanation> rounded(const MotorNames& motors, const ExternalTorques& torques) {
  constexpr int most = 12;
  const auto offBy = [&](std::size_t k, int i, double unit) {
    const double off = offAt(torques, k, i), limit = unit * (1 + 1e-9) + roundingAt(torques, k);
    return std::abs(off) <= limit - 0.5 * unit || (off * torques.noc[k](i) <= 0 && std::abs(off) <= limit);
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

/// Whether a motor's efforts are one number, where the right ones differ beyond their limits.
bool isConstant(const ExternalTorques& torques, const AskedApart& asked, int i) {
  const double value = torques.file.torques.front()(i);
  double least = torques.noc.front()(i), most = least, limit = 0;
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    if (torques.file.torques[k](i) != value) return false;
    least = std::min(least, torques.noc[k](i));
    most = std::max(most, torques.noc[k](i));
    limit = std::max(limit, limitAt(torques, k, i));
  }
  const auto same = [&](const Vector6d& answer) { return answer(i) == value; };
  return most - least > 4 * limit && std::all_of(asked.found.begin(), asked.found.end(), same);
}

/// Whether a motor is right at every instant.
bool isMotorRight(const ExternalTorques& torques, int i) {
  for (std::size_t k = 0; k < torques.file.rows(); ++k)
    if (!(std::abs(offAt(torques, k, i)) <= limitAt(torques, k, i))) return false;
  return true;
}

}  // namespace

std::optional<Explanation> sameAnswers(const MotorNames& motors, const ExternalTorques& torques,
                                       const AskedApart& asked) {
  std::vector<int> which;
  std::string text;
  for (int i = 0; i < motor_count && torques.file.rows() > 0; ++i) {
    if (isConstant(torques, asked, i)) {
      which.push_back(i);
      text += fmt::format("{}{:.6g} {} of {}", text.empty() ? "" : ", ", torques.file.torques.front()(i),
                          motors.unit(i), motors(i));
    } else if (!isMotorRight(torques, i)) {
      return std::nullopt;
    }
  }
  if (which.empty()) return std::nullopt;
  const char* when = asked.terms.empty() ? "at every instant" : "whatever is asked";
  const Vector6d& first = torques.file.torques.front();
  const bool zeros = std::all_of(which.begin(), which.end(), [&](int i) { return first(i) == 0; });
  const bool all = which.size() == motor_count;
  if (!zeros) return Explanation{fmt::format("the same answer {}: {}", when, text)};
  Explanation out{all ? fmt::format("zero for every motor {}", when) : fmt::format("zero {}: {}", when, text),
                  NamedCause{CauseKind::scale, "", all ? "all" : "", "", "", 1.0, 0.0}};
  out.named->explained = 1;
  if (which.size() == 1) out.named->motor = which.front() + 1;
  if (which.size() > 1 && !all)
    for (const int motor : which) out.named->legs.push_back(motor + 1);
  return out;
}

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
