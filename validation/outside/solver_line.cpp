#include "validation/outside/solver_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <locale>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/shown_text.h"
#include "model/manipulator.h"
#include "model/quaternions.h"

namespace ursula {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// std::from_chars reports "out of range" for both too large and too small numbers; a stream distinguishes them.
bool isBelowRange(std::string_view digits) {
  std::istringstream stream{std::string(digits)};
  stream.imbue(std::locale::classic());
  double value = 1;
  return stream >> value && std::abs(value) < 1;
}

/// A number smaller than any double becomes 0.
double numberOf(std::string_view cell, int index) {
  std::string_view digits = trimmed(cell);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_small = error == std::errc::result_out_of_range && isBelowRange(digits);
  if ((error != std::errc{} && !is_small) || end != digits.data() + digits.size() || !std::isfinite(value))
    throw SolverProcessError(
        fmt::format("its effort {} is '{}', expected a finite number", index, shown(trimmed(cell), most_shown)));
  return value;
}

}  // namespace

std::string solverQuestion(const Motion<double>& motion) {
  fmt::memory_buffer line;
  const auto add = [&line](const auto& values) {
    for (Eigen::Index k = 0; k < values.size(); ++k) fmt::format_to(std::back_inserter(line), ",{:.17g}", values(k));
  };
  fmt::format_to(std::back_inserter(line), "{:.17g}", motion.t);
  add(motion.p);
  add(quaternions({motion}).front());
  add(motion.p_dot);
  add(motion.omega);
  add(motion.p_ddot);
  add(motion.omega_dot);
  return fmt::to_string(line);
}

Vector6d solverAnswer(const std::string& line) {
  std::vector<std::string_view> cells;
  const std::string_view text = line;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    cells.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  if (cells.size() != motor_count)
    throw SolverProcessError(
        fmt::format("{} value{}, expected six, separated by commas", cells.size(), cells.size() == 1 ? "" : "s"));
  Vector6d out;
  for (int i = 0; i < motor_count; ++i) out(i) = numberOf(cells[static_cast<std::size_t>(i)], i + 1);
  return out;
}

}  // namespace ursula
