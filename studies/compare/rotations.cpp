#include "studies/compare/rotations.h"

#include <array>

#include "studies/compare/history_line.h"

namespace ursula::compare_parts {
namespace {

using Quaternion = std::array<std::size_t, 4>;  ///< indices of the columns w, x, y, z

std::size_t indexOf(const TimeSeries& series, const std::string& name) {
  const auto found = std::find(series.names.begin(), series.names.end(), name);
  return static_cast<std::size_t>(found - series.names.begin());
}

std::vector<std::string> prefixes(const TimeSeries& series) {
  std::vector<std::string> out;
  for (const std::string& name : series.names)
    if (name.size() >= 3 && name.compare(name.size() - 3, 3, "q_w") == 0)
      out.push_back(name.substr(0, name.size() - 1));
  return out;
}

/// Returns false unless all four columns exist; the others are then compared unchanged.
bool find(const TimeSeries& series, const std::string& prefix, Quaternion& out) {
  const char* parts = "wxyz";
  for (std::size_t k = 0; k < 4; ++k) {
    out[k] = indexOf(series, prefix + parts[k]);
    if (out[k] == series.names.size()) return false;
  }
  return true;
}

void turnSign(TimeSeries& series, const Quaternion& q, std::size_t row) {
  for (const std::size_t column : q) series.columns[column][row] *= -1;
}

}  // namespace

TimeSeries alignQuaternions(const TimeSeries& series) {
  TimeSeries out = series;
  for (const std::string& prefix : prefixes(series)) {
    Quaternion q;
    if (!find(out, prefix, q)) continue;
    for (std::size_t row = 1; row < out.columns[q[0]].size(); ++row) {
      double product = 0;
      for (const std::size_t column : q) product += out.columns[column][row - 1] * out.columns[column][row];
      if (product < 0) turnSign(out, q, row);
    }
  }
  return out;
}

TimeSeries alignQuaternions(const TimeSeries& reference, const TimeSeries& test, const std::vector<std::size_t>& rows) {
  TimeSeries out = test;
  const TimeSeries continuous = alignQuaternions(reference);
  for (const std::string& prefix : prefixes(test)) {
    Quaternion q, other;
    if (!find(test, prefix, q) || !find(reference, prefix, other)) continue;
    for (const std::size_t row : rows) {
      double product = 0;
      for (std::size_t k = 0; k < 4; ++k)
        product += HistoryLine(*reference.find("t_s"), continuous.columns[other[k]]).at((*test.find("t_s"))[row]) *
                   test.columns[q[k]][row];
      if (product < 0) turnSign(out, q, row);
    }
  }
  return out;
}

bool isChosen(const std::string& column, const std::vector<std::string>& patterns) {
  const auto matches = [&column](const std::string& pattern) {
    const std::size_t star = pattern.find('*');
    if (star == std::string::npos) return pattern == column;
    const std::string before = pattern.substr(0, star), after = pattern.substr(star + 1);
    return column.size() >= before.size() + after.size() && column.compare(0, before.size(), before) == 0 &&
           column.compare(column.size() - after.size(), after.size(), after) == 0;
  };
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), matches);
}

}  // namespace ursula::compare_parts
