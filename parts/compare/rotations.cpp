#include "parts/compare/rotations.h"

#include "parts/compare/history_line.h"

namespace ursula::compare_parts {
namespace {

/// Returns the columns w, x, y, z of the quaternion; none unless all four exist, which are then compared unchanged.
template <class Series>
auto columnsOf(Series& series, const std::string& prefix) {
  std::vector<decltype(&series.columns[0])> out;
  for (const char part : {'w', 'x', 'y', 'z'}) {
    const auto found = std::find(series.names.begin(), series.names.end(), prefix + part);
    if (found == series.names.end()) return decltype(out)();
    out.push_back(&series.columns[found - series.names.begin()]);
  }
  return out;
}

std::vector<std::string> prefixes(const TimeSeries& series) {
  std::vector<std::string> out;
  for (const std::string& name : series.names)
    if (name.size() >= 3 && name.compare(name.size() - 3, 3, "q_w") == 0)
      out.push_back(name.substr(0, name.size() - 1));
  return out;
}

/// Turns the sign of row `row` if its product with `near(k)`, the k-th entry of a near quaternion, is negative.
template <class Near>
void turnTo(const Near& near, const std::vector<std::vector<double>*>& q, std::size_t row) {
  double product = 0;
  for (std::size_t k = 0; k < q.size(); ++k) product += near(k) * (*q[k])[row];
  for (std::vector<double>* column : q)
    if (product < 0) (*column)[row] *= -1;
}

}  // namespace

void makeContinuous(TimeSeries& series) {
  for (const std::string& prefix : prefixes(series)) {
    const auto q = columnsOf(series, prefix);
    for (std::size_t row = 1; !q.empty() && row < q[0]->size(); ++row)
      turnTo([&](std::size_t k) { return (*q[k])[row - 1]; }, q, row);
  }
}

void alignQuaternions(const TimeSeries& reference, const std::vector<std::size_t>& rows, TimeSeries& test) {
  const std::vector<double>&t = *test.find("t_s"), &t_reference = *reference.find("t_s");
  for (const std::string& prefix : prefixes(test)) {
    const auto q = columnsOf(test, prefix);
    const auto other = columnsOf(reference, prefix);
    for (const std::size_t row : rows)
      if (!q.empty() && !other.empty())
        turnTo([&](std::size_t k) { return HistoryLine(t_reference, *other[k]).at(t[row]); }, q, row);
  }
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
