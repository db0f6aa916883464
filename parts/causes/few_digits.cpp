#include "parts/causes/few_digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"

namespace ursula {
namespace {

bool areRounded(const std::vector<Answer>& answers, const std::function<std::string(double)>& text,
                const std::function<double(double)>& unitAt) {
  return std::all_of(answers.begin(), answers.end(), [&](const Answer& each) {
    const double unit = unitAt(each.found), off = each.found - each.right;
    const double limit = unit * (1 + 1e-9) + each.rounding;
    const bool is_near = std::abs(off) <= limit - 0.5 * unit || (off * each.right <= 0 && std::abs(off) <= limit);
    return is_near && leadingNumber(text(each.found)).value == each.found;
  });
}

}  // namespace

bool areNearSingle(const std::vector<Answer>& answers) {
  return !answers.empty() && std::all_of(answers.begin(), answers.end(), [](const Answer& each) {
    return std::abs(each.found - each.right) <= std::ldexp(std::abs(each.right), -23) + each.limit;
  });
}

std::optional<std::string> roundedTo(const std::vector<Answer>& answers, const std::string& unit) {
  constexpr int least = 2, most = 12;  // one digit is right by chance too often
  if (answers.empty()) return std::nullopt;
  double largest = 0;
  for (const Answer& each : answers) largest = std::max(largest, std::abs(each.found));
  for (int digits = least; digits <= most; ++digits) {
    const auto text = [digits](double value) { return fmt::format("{:.{}e}", value, digits - 1); };
    const auto last_digit = [digits](double value) {
      return value == 0 ? 0 : std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
    };
    if (areRounded(answers, text, last_digit)) return fmt::format("{} significant digits", digits);
  }
  for (int places = 0; places <= most; ++places) {
    const double last = std::pow(10.0, -places);
    const auto text = [places](double value) { return fmt::format("{:.{}f}", value, places); };
    if (10 * last <= largest && areRounded(answers, text, [last](double) { return last; }))
      return fmt::format("{:g} {}", last, unit);
  }
  return std::nullopt;
}

}  // namespace ursula
