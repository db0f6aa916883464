#include "validation/result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ursula {
namespace {

bool anyIs(const std::vector<Check>& checks, Verdict verdict) {
  return std::any_of(checks.begin(), checks.end(), [verdict](const Check& check) { return check.verdict == verdict; });
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::inconclusive:
      return "inconclusive";
  }
  throw std::logic_error("no such verdict");
}

Check judged(std::string name, double value, double limit, std::string unit, std::string basis, std::string why) {
  // An infinite limit would accept anything: it is a limit that was not found.
  const bool accepted = value <= limit && std::isfinite(value) && std::isfinite(limit);
  return {std::move(name),  value,         limit, std::move(unit), accepted ? Verdict::pass : Verdict::fail,
          std::move(basis), std::move(why)};
}

Check notMade(std::string name, std::string unit, std::string why) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {std::move(name), none, none, std::move(unit), Verdict::fail, "", std::move(why)};
}

Check notJudgeable(std::string name, double value, double limit, std::string unit, std::string basis, std::string why) {
  return {std::move(name), value, limit, std::move(unit), Verdict::inconclusive, std::move(basis), std::move(why)};
}

Verdict overall(const std::vector<Check>& checks) {
  if (checks.empty() || anyIs(checks, Verdict::fail)) return Verdict::fail;
  return anyIs(checks, Verdict::inconclusive) ? Verdict::inconclusive : Verdict::pass;
}

void TimeSeries::add(std::string column_name, std::vector<double> values) {
  if (find(column_name) != nullptr) throw std::invalid_argument("column " + column_name + " is there already");
  if (!columns.empty() && values.size() != rows()) {
    throw std::invalid_argument("column " + column_name + " has " + std::to_string(values.size()) + " rows, expected " +
                                std::to_string(rows()));
  }
  names.push_back(std::move(column_name));
  columns.push_back(std::move(values));
}

const std::vector<double>* TimeSeries::find(const std::string& column_name) const {
  const auto found = std::find(names.begin(), names.end(), column_name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace ursula
