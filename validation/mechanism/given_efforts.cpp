#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/csv.h"
#include "base/text.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/printed_precision.h"
#include "validation/subject/torque_columns.h"

namespace ursula {
namespace {

/// Instants k·step are exact, since rounding would be visible; others may be off by half of their last digit.
void setTimePrecision(const std::vector<int>& places, GivenEfforts& out) {
  constexpr double rounding_of_sums = 1e-13;
  if (out.t.size() < 3) return;
  const double step = (out.t.back() - out.t.front()) / static_cast<double>(out.t.size() - 1);
  double off = 0;
  for (std::size_t i = 0; i < out.t.size(); ++i)
    off = std::max(off, std::abs(out.t[i] - (out.t.front() + static_cast<double>(i) * step)));
  const double half = 0.5 * std::pow(10.0, *std::min_element(places.begin(), places.end()));
  if (off <= rounding_of_sums * out.t.back() || half <= rounding_of_sums * out.t.back()) return;
  out.time_precision.assign(out.t.size(), half);
}

void requireInstants(const CsvTable& table, std::vector<double>& t, double duration) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i > 0 && !(t[i] > t[i - 1]))
      throw CsvError(fmt::format("{}: error: t_s = {} does not come after {}, expected increasing instants",
                                 table.place(i), t[i], t[i - 1]));
    if (!(t[i] >= -1e-9 * duration && t[i] <= duration * (1 + 1e-9)))
      throw CsvError(fmt::format("{}: error: t_s = {} lies outside of the motion, expected 0 to {} s", table.place(i),
                                 t[i], duration));
    t[i] = std::clamp(t[i], 0.0, duration);
  }
}

GivenEfforts effortsIn(const std::string& text, const std::filesystem::path& file, const Mechanism& mechanism,
                       double duration, const ColumnMap& map) {
  const TorqueColumns read = readTorqueColumns(text, file, map, mechanism);
  const CsvTable& table = read.table;
  GivenEfforts out;
  out.name = file.filename().string();
  out.read_as = read.read_as;
  out.all_single = read.all_single;
  out.ignored = table.ignored;
  out.t = table.columns.front();
  const std::size_t n = mechanism.motorCount();
  out.efforts.assign(table.rows(), Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n)));
  out.precision = out.efforts;
  PrintedPrecision printed;
  for (std::size_t k = 1; k <= n; ++k)
    for (std::size_t i = 0; i < table.rows(); ++i) printed.add(table.columns[k][i], table.last_places[k][i]);
  for (std::size_t k = 1; k <= n; ++k)
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const auto motor = static_cast<Eigen::Index>(k - 1);
      const double value = table.columns[k][i];
      out.efforts[i](motor) = value * read.multipliers[k];
      out.precision[i](motor) = printed.of(value, table.last_places[k][i]) * read.multipliers[k];
    }
  setTimePrecision(table.last_places.front(), out);
  requireInstants(table, out.t, duration);
  return out;
}

}  // namespace

GivenEfforts readMotorEfforts(const std::filesystem::path& file, const Mechanism& mechanism, double duration,
                              const ColumnMap& map) {
  GivenEfforts out = effortsIn(readCsvText(file), file, mechanism, duration, map);
  out.is_read = true;
  return out;
}

GivenEfforts givenEfforts(const std::string& name, const std::vector<double>& t,
                          const std::vector<MotorEfforts>& efforts, const Mechanism& mechanism, double duration) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "t_s");
  for (std::size_t k = 0; k < mechanism.motorCount(); ++k) fmt::format_to(out, ",{}", motorColumn(mechanism, k, "tau"));
  for (std::size_t i = 0; i < t.size(); ++i) {
    fmt::format_to(out, "\n{}", t[i]);
    for (const double effort : efforts.at(i)) fmt::format_to(out, ",{}", effort);
  }
  GivenEfforts read = effortsIn(fmt::to_string(text), name, mechanism, duration, {});
  read.name = name;
  return read;
}

}  // namespace ursula
