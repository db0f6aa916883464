#include "parts/causes/answers_alone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "parts/causes/few_digits.h"

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

std::vector<Answer> allAnswers(const ExternalTorques& torques) {
  std::vector<Answer> out;
  for (std::size_t k = 0; k < torques.file.rows(); ++k)
    for (int i = 0; i < motor_count; ++i)
      out.push_back({torques.file.torques[k](i), torques.noc[k](i), limitAt(torques, k, i), roundingAt(torques, k)});
  return out;
}

/// Explains deviations that are about as large as the jumps of the motor's answers to nearly the same question. The
/// jumps must exceed rounding in doubles. Every motor must be off: digits lost within a solver spare none.
std::optional<Explanation> grainy(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked) {
  constexpr double grains = 100, more_than_rounding = 100, least = 1e-10, most = 1e-4;
  const double largest = torques.sizes.of(Rounded::torque), grain = asked.grain.maxCoeff();
  double rounding = 0;
  for (std::size_t k = 0; k < torques.file.rows(); ++k) rounding = std::max(rounding, roundingAt(torques, k));
  if (!(grain > std::max(least * largest, more_than_rounding * rounding) && grain < most * largest))
    return std::nullopt;
  if (wrongMotors(torques).size() < motor_count) return std::nullopt;
  const bool all = holdsForAll(
      torques, [&](std::size_t k, int i) { return std::abs(offAt(torques, k, i)) <= grains * asked.grain(i); });
  if (!all) return std::nullopt;
  return ofDigits(
      fmt::format("single precision, or few digits, within the solver: answers to nearly the same question jump by "
                  "{:.2g} {}, {:.1g} of the largest, and none is off by more than {:g} times that",
                  grain, motors.unit(0), grain / largest, grains));
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

/// Whether the motors `from` to `to` are right at the instants `first` to `last`.
bool areRight(const ExternalTorques& torques, std::size_t first, std::size_t last, int from, int to) {
  for (std::size_t k = first; k < last; ++k)
    for (int i = from; i < to; ++i)
      if (!(std::abs(offAt(torques, k, i)) <= limitAt(torques, k, i))) return false;
  return true;
}
bool isMotorRight(const ExternalTorques& torques, int i) { return areRight(torques, 0, torques.file.rows(), i, i + 1); }

/// A motor's efforts, and those that are cut off along the motion.
struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;
  std::vector<double> cut;

  /// Whether the answer is that of right efforts beyond the range.
  bool isCut(double answer, double right, double limit) const {
    const double equal = 1e-12 * std::max(std::abs(least), std::abs(most));
    return (std::abs(answer - most) <= equal && right > most - limit) ||
           (std::abs(answer - least) <= equal && right < least + limit);
  }
};

/// The range of one motor; none if it is wrong within it.
std::optional<Range> rangeOf(const ExternalTorques& torques, const AskedApart& asked, int i) {
  Range out;
  const auto reach = [&](double answer) {
    out.least = std::min(out.least, answer);
    out.most = std::max(out.most, answer);
  };
  for (const Vector6d& answer : torques.file.torques) reach(answer(i));
  for (const Vector6d& answer : asked.found) reach(answer(i));
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    const double limit = limitAt(torques, k, i);
    if (std::abs(offAt(torques, k, i)) <= limit) continue;
    if (!out.isCut(torques.file.torques[k](i), torques.noc[k](i), limit)) return std::nullopt;
    out.cut.push_back(torques.file.torques[k](i));
  }
  for (std::size_t k = 0; k < asked.found.size(); ++k)
    if (!(std::abs(asked.found[k](i) - asked.expected[k](i)) <= asked.rounding[k]) &&
        !out.isCut(asked.found[k](i), asked.expected[k](i), asked.rounding[k]))
      return std::nullopt;
  return out;
}

/// Whether each occurs three times, with any sign: once or twice it may be the largest by chance.
bool areRepeated(const std::vector<double>& efforts) {
  constexpr int enough = 3;
  return std::all_of(efforts.begin(), efforts.end(), [&](double one) {
    return std::count_if(efforts.begin(), efforts.end(), [one](double other) {
             return std::abs(std::abs(other) - std::abs(one)) <= 1e-12 * std::abs(one);
           }) >= enough;
  });
}

/// Explains efforts that never leave a range of a motor's own, and are right wherever the right ones are within it.
std::optional<Explanation> cutOff(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked) {
  std::vector<int> which;
  std::string text;
  std::size_t right = 0;
  std::vector<double> all;
  for (int i = 0; i < motor_count; ++i) {
    const std::optional<Range> range = rangeOf(torques, asked, i);
    if (!range) return std::nullopt;
    if (range->cut.empty()) continue;
    all.insert(all.end(), range->cut.begin(), range->cut.end());
    which.push_back(i);
    text += fmt::format("{}{:.6g} to {:.6g} {} of {}", text.empty() ? "" : ", ", range->least, range->most,
                        motors.unit(i), motors(i));
  }
  if (!areRepeated(all)) return std::nullopt;
  Explanation out{"cut off, and right within the range: " + text, NamedCause{CauseKind::window}};
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    if (areRight(torques, k, k + 1, 0, motor_count)) {
      ++right;
      continue;
    }
    if (!out.named->from_s) out.named->from_s = torques.file.t[k];
    out.named->to_s = torques.file.t[k];
  }
  if (which.empty() || 10 * right < torques.file.rows()) return std::nullopt;
  out.named->explained = 1;
  nameMotors(which, *out.named);
  return out;
}

/// Explains motors that answer the same at every instant, and whatever they are asked, where the right efforts vary.
/// The others must be right.
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
                  NamedCause{CauseKind::scale, "", "", "", "", 1.0, 0.0}};
  out.named->explained = 1;
  nameMotors(which, *out.named);
  return out;
}

/// Explains efforts that lack only digits. These are single-precision numbers. From a solver they are also rounded
/// answers, and answers to nearly the same question that jump by about the deviation.
std::optional<Explanation> fewDigits(const MotorNames& motors, const ExternalTorques& torques,
                                     const AskedApart& asked) {
  const std::vector<Answer> answers = allAnswers(torques);
  if (torques.file.all_single && areNearSingle(answers))
    return ofDigits("single precision: every torque is a 24-bit number, off by no more than such numbers are");
  if (asked.motions.empty()) return std::nullopt;  // a file's limits include its digits
  if (const auto rounded = roundedTo(answers, motors.unit(0)))
    return ofDigits("few digits: every answer is rounded to " + *rounded);
  return grainy(motors, torques, asked);
}

double changedWhenAskedAgain(const ExternalTorques& torques, const AskedApart& asked) {
  constexpr double may_be_rounding = 2;  // the limits of both answers
  double change = 0, largest = torques.sizes.of(Rounded::torque);
  for (std::size_t k = 0; k < torques.file.rows(); ++k) {
    const Vector6d& answer = torques.file.torques[k];
    largest = std::max(largest, answer.cwiseAbs().maxCoeff());
    const double growth = std::max(1.0, answer.norm() / std::max(torques.noc[k].norm(), 1e-300));
    for (std::size_t j = 0; j < asked.again.size(); ++j) {
      if (asked.again_t[j] != torques.file.t[k]) continue;
      const double off = (asked.again[j] - answer).cwiseAbs().maxCoeff();
      if (off > may_be_rounding * growth * roundingAt(torques, k)) change = std::max(change, off);
    }
  }
  return largest > 0 ? change / largest : 0;
}

}  // namespace

std::vector<int> wrongMotors(const ExternalTorques& torques) {
  std::vector<int> out;
  for (int i = 0; i < motor_count; ++i)
    if (!isMotorRight(torques, i)) out.push_back(i);
  return out;
}

AnswersAlone readAlone(const MotorNames& motors, const ExternalTorques& torques, const AskedApart& asked) {
  if (!asked.no_cause.empty()) return {false, Explanation{asked.no_cause}};
  const std::optional<Explanation> digits = fewDigits(motors, torques, asked);
  AnswersAlone out{digits.has_value(), sameAnswers(motors, torques, asked), changedWhenAskedAgain(torques, asked)};
  if (!out.explanation) out.explanation = digits ? digits : cutOff(motors, torques, asked);
  return out;
}

}  // namespace ursula
