#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/csv.h"
#include "base/text.h"
#include "validation/mechanism/validate_mechanism.h"
#include "validation/subject/printed_precision.h"

namespace ursula {
namespace {

/// The column of motor k, by its number or its joint's name.
std::string columnOf(const CsvTable& table, const Mechanism& mechanism, std::size_t k) {
  const std::string by_number = motorColumn(mechanism, k, "tau"), joint = mechanism.motor(k).name;
  const std::string unit = mechanism.effortUnit(k);
  for (const std::string& name : {by_number, fmt::format("tau_{}_{}", joint, unit), fmt::format("{}_{}", joint, unit)})
    if (table.find(name) != nullptr) return name;
  return by_number;
}

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

using ColumnNames = std::vector<std::pair<std::string, std::string>>;

GivenEfforts effortsIn(const CsvTable& table, const Mechanism& mechanism, double duration, const ColumnNames& map) {
  const auto mapped = [&](const std::string& name) {
    const auto found = std::find_if(map.begin(), map.end(), [&](const auto& each) { return each.first == name; });
    return found == map.end() ? std::string() : found->second;
  };
  GivenEfforts out;
  out.name = table.file.filename().string();
  const std::string time = mapped("t_s").empty() ? "t_s" : mapped("t_s");
  out.t = table.at(time);
  std::vector<std::string> used = {time};
  const auto n = static_cast<Eigen::Index>(mechanism.motorCount());
  out.efforts.assign(table.rows(), Eigen::VectorXd::Zero(n));
  out.precision = out.efforts;
  PrintedPrecision printed;
  std::vector<const std::vector<int>*> places;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto motor = static_cast<std::size_t>(k);
    const std::string own = mapped(motorColumn(mechanism, motor, "tau"));
    const std::string name = own.empty() ? columnOf(table, mechanism, motor) : own;
    const std::vector<double>& values = table.at(name);
    used.push_back(name);
    const auto column =
        static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), name) - table.names.begin());
    places.push_back(&table.last_places[column]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      out.efforts[i](k) = values[i];
      printed.add(values[i], (*places.back())[i]);
    }
  }
  for (Eigen::Index k = 0; k < n; ++k)
    for (std::size_t i = 0; i < out.t.size(); ++i)
      out.precision[i](k) = printed.of(out.efforts[i](k), (*places[static_cast<std::size_t>(k)])[i]);
  for (const std::string& name : table.names)
    if (std::find(used.begin(), used.end(), name) == used.end()) out.ignored.push_back(name);
  const auto at =
      static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), time) - table.names.begin());
  setTimePrecision(table.last_places[at], out);
  requireInstants(table, out.t, duration);
  return out;
}

}  // namespace

GivenEfforts readMotorEfforts(const std::filesystem::path& file, const Mechanism& mechanism, double duration,
                              const ColumnNames& map) {
  GivenEfforts out = effortsIn(readCsv(file), mechanism, duration, map);
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
  GivenEfforts read = effortsIn(parseCsv(fmt::to_string(text), name), mechanism, duration, {});
  read.name = name;
  return read;
}

}  // namespace ursula
