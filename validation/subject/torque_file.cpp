#include "validation/subject/torque_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "base/csv.h"
#include "base/text.h"
#include "model/torque_names.h"
#include "validation/subject/printed_precision.h"

namespace ursula {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Closer times, s, would make the rates of torques overflow.
constexpr double shortest = 1e-70;

void requireIncreasing(const CsvTable& table, const std::vector<double>& t) {
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] - t[k - 1] >= shortest) continue;
    if (t[k] > t[k - 1])
      throw CsvError(fmt::format("{}: error: t_s = {} is {:.3g} s after line {}, expected at least {:g} s",
                                 table.place(k), t[k], t[k] - t[k - 1], table.lines[k - 1], shortest));
    const std::string what =
        t[k] == t[k - 1] ? fmt::format("t_s = {} repeats line {}", t[k], table.lines[k - 1])
                         : fmt::format("t_s = {} comes after {} of line {}", t[k], t[k - 1], table.lines[k - 1]);
    throw CsvError(fmt::format("{}: error: {}, expected increasing instants", table.place(k), what));
  }
}

enum class Grid { none, rounded, exact };

/// Whether the instants are k·step (exact), or were before rounding to their last printed digit.
Grid gridOf(const std::vector<double>& t, double half) {
  if (t.size() < 3) return Grid::none;
  const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const double rounding = 4 * eps * std::max(std::abs(t.front()), std::abs(t.back()));
  double largest = std::abs(std::remainder(t.front(), step));  // a grid that starts elsewhere may hide rounding
  for (std::size_t k = 1; k + 1 < t.size(); ++k)
    largest = std::max(largest, std::abs(t[k] - (t.front() + static_cast<double>(k) * step)));
  if (largest <= rounding) return Grid::exact;
  return largest <= 2 * half + rounding ? Grid::rounded : Grid::none;  // the grid's ends are also rounded: two halves
}

void setTimePrecision(const std::vector<int>& places, const PrintedPrecision& whole, TorqueFile& out) {
  const double half = 0.5 * std::pow(10.0, *std::min_element(places.begin(), places.end()));
  const Grid grid = gridOf(out.t, half);
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    const double at_own_digit = half > eps * std::abs(out.t[k]) ? half : 0;
    out.time_precision.push_back(grid == Grid::exact     ? 0
                                 : grid == Grid::rounded ? at_own_digit
                                                         : whole.of(out.t[k], places[k]));
  }
}

/// The table has the time, then the efforts of the motors.
TorqueFile torquesOf(const CsvTable& table, const std::vector<double>& multipliers) {
  TorqueFile out;
  out.file = table.file;
  out.lines = table.lines;
  out.ignored = table.ignored;
  out.t = table.columns.front();
  requireIncreasing(table, out.t);
  PrintedPrecision torques;
  out.torques.resize(table.rows());
  out.torque_precision.resize(table.rows());
  for (std::size_t k = 0; k < table.rows(); ++k)
    for (std::size_t i = 0; i < motor_count; ++i) {
      const double value = table.columns[1 + i][k];
      out.torques[k](static_cast<Eigen::Index>(i)) = value * multipliers[1 + i];
      torques.add(value, table.last_places[1 + i][k]);
    }
  for (std::size_t k = 0; k < table.rows(); ++k)
    for (std::size_t i = 0; i < motor_count; ++i)
      out.torque_precision[k](static_cast<Eigen::Index>(i)) =
          torques.of(table.columns[1 + i][k], table.last_places[1 + i][k]) * multipliers[1 + i];
  out.digits = torques.digits();
  PrintedPrecision whole = torques;
  const std::vector<int>& places = table.last_places.front();
  for (std::size_t k = 0; k < table.rows(); ++k) whole.add(out.t[k], places[k]);
  setTimePrecision(places, whole, out);
  return out;
}

}  // namespace

TorqueFile readTorqueFile(const std::filesystem::path& file, const ColumnMap& map, const Motors& motors) {
  TorqueFile out = parseTorqueFile(readCsvText(file), file, map, motors);
  out.is_read = true;
  return out;
}

TorqueFile parseTorqueFile(const std::string& text, const std::filesystem::path& file, const ColumnMap& map,
                           const Motors& motors) {
  const TorqueColumns columns = readTorqueColumns(text, file, map, motors);
  TorqueFile out = torquesOf(columns.table, columns.multipliers);
  out.read_as = columns.read_as;
  out.all_single = columns.all_single;
  for (const auto& [name, column] : map) out.map += (out.map.empty() ? "" : " --map ") + shellWord(name + "=" + column);
  return out;
}

TorqueFile torqueFileOf(const GivenTorques& table, const Motors& motors) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "t_s");
  for (int i = 0; i < motor_count; ++i) fmt::format_to(out, ",{}", effortColumn(motors, i));
  for (std::size_t k = 0; k < table.t.size(); ++k) {
    fmt::format_to(out, "\n{}", table.t[k]);
    for (const double torque : table.torques[k]) fmt::format_to(out, ",{}", torque);
  }
  return parseTorqueFile(fmt::to_string(text), table.name, {}, motors);
}

double timeRounding(const TorqueFile& file, double duration) {
  return eps * duration * static_cast<double>(std::max<std::size_t>(4, file.rows()));
}

namespace {

/// Returns the probable meaning of instants outside the motion, in words; empty if unknown.
std::string likelyInstants(const TorqueFile& file, double duration) {
  const double first = file.t.front(), last = file.t.back(), rows = static_cast<double>(file.rows());
  const auto near = [](double value, double expected) { return std::abs(value / expected - 1) < 0.01; };
  for (const auto& [power, name, unit] : {std::tuple{1e3, "milliseconds", "t_ms"}, {1e6, "microseconds", "t_us"}})
    if (near(last, power * duration))
      return fmt::format(
          "; they look like {}: the last one is {:g} times the motion's duration. If they are, say so: --map {}=COLUMN",
          name, power, unit);
  if (file.rows() >= 3 && (first == 0 || first == 1) && last - first == rows - 1) return "; they look like row numbers";
  if (first != 0 && near(last - first, duration))
    return fmt::format("; they look shifted by {:.6g} s: they last as long as the motion", first);
  return "";
}

}  // namespace

TorqueFile within(TorqueFile file, double duration) {
  const std::string likely = likelyInstants(file, duration);
  for (std::size_t k = 0; k < file.rows(); ++k) {
    const double rounding = file.time_precision[k] + timeRounding(file, duration);
    if (!(file.t[k] >= -rounding && file.t[k] <= duration + rounding))
      throw CsvError(fmt::format("{}:{}: error: t_s = {} lies outside of the motion, expected 0 to {} s{}",
                                 file.file.string(), file.lines[k], file.t[k], duration, likely));
    file.t[k] = std::clamp(file.t[k], 0.0, duration);
  }
  return file;
}

bool covers(const TorqueFile& file, double duration) {
  const double rounding = timeRounding(file, duration);
  return !file.t.empty() && file.t.front() <= file.time_precision.front() + rounding &&
         file.t.back() >= duration - file.time_precision.back() - rounding;
}

}  // namespace ursula
