#include "parts/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "base/csv.h"
#include "base/scalar.h"
#include "base/text.h"
#include "parts/compare/history_line.h"
#include "parts/compare/rotations.h"

namespace ursula {
namespace {

using compare_parts::isChosen;

constexpr double eps = std::numeric_limits<double>::epsilon();
const char* const work_group = "efforts x what they drive";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// `tau_3_Nm` → `tau_*_Nm`: channels with equal unit and meaning share a scale.
std::string groupOf(const std::string& channel) {
  std::stringstream in(channel);
  std::string out, part;
  while (std::getline(in, part, '_')) {
    const bool is_index = part.size() == 1 && std::string("123456wxyz").find(part) != std::string::npos;
    // The first part is the quantity, so the "w" of an angular velocity is no index.
    out += (out.empty() ? "" : "_") + (is_index && !out.empty() ? "*" : part);
  }
  return out;
}

/// Returns the group whose scale applies to an error, because the error's own size is only rounding.
std::string scaleGroupOf(const std::string& channel) {
  static const std::map<std::string, std::string> of = {
      {"error_p_m", "p_*_m"},
      {"closure_p_m", "p_*_m"},
      {"closure_m", "output_*_m"},
      {"error_q_rad", "q_*"},
      {"closure_v_m_s", "v_*_m_s"},
      {"error_acceleration_m_s2", "a_*_m_s2"},
      {"limit_acceleration_m_s2", "a_*_m_s2"},
      {"error_energy_J", work_group},
  };
  const std::string group = groupOf(channel);
  for (const char* const of_efforts : {"error_tau", "limit_tau"})
    if (group.rfind(of_efforts, 0) == 0) return "tau_*" + group.substr(group.rfind('_'));
  const auto found = of.find(group);
  return found == of.end() ? group : found->second;
}

/// Largest finite magnitude of every group. Energy errors get that of the work: torques times angles, forces times
/// displacements.
std::map<std::string, double> scalesOf(const TimeSeries& series) {
  std::map<std::string, double> scales;
  for (std::size_t i = 0; i < series.names.size(); ++i) {
    double& scale = scales[groupOf(series.names[i])];
    for (double value : series.columns[i])
      if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  }
  for (const auto& [effort, driven] : {std::pair("tau_*_Nm", "phi_*_rad"), {"tau_*_N", "d_*_m"}})
    if (scales.count(effort) != 0 && scales.count(driven) != 0)
      scales[work_group] = std::max(scales[work_group], scales[effort] * scales[driven]);
  return scales;
}

/// Computes errors at the test's instants `rows`, and the distance from the tube.
void judgeRows(const HistoryLine& reference, const std::vector<double>& t, const std::vector<double>& values,
               const std::vector<std::size_t>& rows, double time_tolerance, ChannelComparison& out) {
  double squares = 0;
  bool exceeds = false;
  for (const std::size_t k : rows) {
    const double error = std::abs(values[k] - reference.at(t[k]));
    const double distance = reference.distance(values[k], t[k] - time_tolerance, t[k] + time_tolerance);
    const double missed = reference.interpolationError(t[k]);
    if (error > out.max_error || k == rows.front() || std::isnan(error)) out.max_at = t[k];
    out.max_error = larger(out.max_error, error);
    out.outside = larger(out.outside, distance);
    out.interpolation = larger(out.interpolation, missed);
    out.final_error = error;
    squares += error * error;
    if (!std::isfinite(error) || !(distance <= out.tolerance + missed)) exceeds = true;
    if (std::isnan(error)) break;
  }
  out.rms_error = std::sqrt(squares / static_cast<double>(rows.size()));
  if (std::isnan(out.max_error)) out.final_error = out.rms_error = nan;
  if (std::isfinite(out.max_error) && out.outside <= out.tolerance)
    out.verdict = Verdict::pass;
  else
    out.verdict = exceeds || rows.empty() ? Verdict::fail : Verdict::inconclusive;
}

ChannelCurves curvesOf(const HistoryLine& reference, const std::vector<double>& t, const std::vector<double>& values,
                       const std::vector<std::size_t>& rows, double tolerance, double time_tolerance) {
  ChannelCurves out;
  for (const std::size_t k : rows) {
    const auto [low, high] = reference.range(t[k] - time_tolerance, t[k] + time_tolerance);
    out.t.push_back(t[k]);
    out.reference.push_back(reference.at(t[k]));
    out.test.push_back(values[k]);
    out.low.push_back(low - tolerance);
    out.high.push_back(high + tolerance);
  }
  return out;
}

void setTimes(const std::vector<double>& reference, const std::vector<double>& test, double rounding, Comparison& out) {
  out.reference_from = reference.front(), out.reference_to = reference.back();
  out.test_from = test.front(), out.test_to = test.back();
  if (std::max(reference.front(), test.front()) <= std::min(reference.back(), test.back()) + rounding) {
    out.from = std::max(reference.front(), test.front());
    out.to = std::min(reference.back(), test.back());
  }
  out.covers_reference = test.front() <= reference.front() + rounding && test.back() >= reference.back() - rounding;
}

/// The gap between two instants of the test.
struct Gap {
  std::size_t passed = 0;  ///< number of the reference's instants in it
  bool is_wide = false;    ///< wider than the reference's own step there
};

std::vector<Gap> gapsOf(const std::vector<double>& reference, const std::vector<double>& test, double rounding) {
  std::vector<Gap> out;
  for (std::size_t k = 0; k + 1 < test.size(); ++k) {
    const auto first = std::upper_bound(reference.begin(), reference.end(), test[k] + rounding);
    const auto last = std::lower_bound(first, reference.end(), test[k + 1] - rounding);
    Gap gap;
    if (first < last) {
      gap.passed = last - first;
      const auto from = first == reference.begin() ? first : first - 1, to = last == reference.end() ? last - 1 : last;
      gap.is_wide = from < to && test[k + 1] - test[k] > 1.5 * (*to - *from) / static_cast<double>(to - from);
    }
    out.push_back(gap);
  }
  return out;
}

/// Counts the reference's instants that the test skips: where it is less than a third as dense, or less dense than
/// nearly everywhere else, as at a missing row.
std::size_t skippedOf(const std::vector<double>& reference, const std::vector<double>& test, double rounding) {
  constexpr std::size_t few = 3;
  const std::vector<Gap> gaps = gapsOf(reference, test, rounding);
  std::array<std::size_t, few> counts{};
  for (const Gap& gap : gaps)
    if (gap.passed < few) ++counts[gap.passed];
  const std::size_t usual = std::max_element(counts.begin(), counts.end()) - counts.begin();
  const bool is_even = 4 * counts[usual] >= 3 * gaps.size();
  std::size_t skipped = 0;
  for (const Gap& gap : gaps)
    if (gap.is_wide && (gap.passed >= few || (is_even && gap.passed > usual))) skipped += gap.passed;
  return skipped;
}

/// The largest rounding of the reference's times at which neighbouring instants remain distinct.
double roundingOf(const std::vector<double>& reference) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < reference.size(); ++k) least = std::min(least, reference[k + 1] - reference[k]);
  return std::min(4 * eps * std::max(std::abs(reference.front()), std::abs(reference.back())), least / 4);
}

/// Columns by their names.
std::unordered_map<std::string_view, const std::vector<double>*> byName(const TimeSeries& series) {
  std::unordered_map<std::string_view, const std::vector<double>*> out;
  for (std::size_t i = 0; i < series.names.size(); ++i) out.emplace(series.names[i], &series.columns[i]);
  return out;
}

/// Returns the test's instants within the reference's. Instants between two of the reference are included only if it is
/// interpolated.
std::vector<std::size_t> rowsToCompare(const std::vector<double>& reference, const std::vector<double>& test,
                                       double rounding, const CompareOptions& options, Comparison& out) {
  const HistoryLine times(reference, reference);
  std::vector<std::size_t> within;
  for (std::size_t k = 0; k < test.size(); ++k)
    if (test[k] >= reference.front() - rounding && test[k] <= reference.back() + rounding) within.push_back(k);
  const auto first = std::lower_bound(reference.begin(), reference.end(), out.from - rounding);
  const auto last = std::upper_bound(reference.begin(), reference.end(), out.to + rounding);
  // If the reference is at least as dense as the test, its interpolation is reliable.
  const bool is_finer = !within.empty() && last - first >= static_cast<std::ptrdiff_t>(within.size());
  std::vector<std::size_t> rows;
  for (const std::size_t k : within) {
    const bool between = !times.isKnot(test[k]);
    if (between && !options.interpolate.value_or(is_finer)) {
      ++out.left_out;
      continue;
    }
    out.interpolated += between ? 1 : 0;
    rows.push_back(k);
  }
  out.instants = rows.size();
  return rows;
}

Verdict verdictOf(const Comparison& comparison) {
  if (comparison.channels.empty() || comparison.instants + comparison.left_out == 0) return Verdict::fail;
  bool is_whole = comparison.only_in_reference.empty() && comparison.covers_reference && comparison.skipped == 0 &&
                  comparison.left_out == 0;
  for (const ChannelComparison& channel : comparison.channels) {
    if (channel.verdict == Verdict::fail) return Verdict::fail;
    is_whole = is_whole && channel.verdict == Verdict::pass;
  }
  return is_whole ? Verdict::pass : Verdict::inconclusive;
}

/// Throws for a pattern that matches no column of either side.
void refuseUnknown(const std::vector<std::string>& patterns, const TimeSeries& reference, const TimeSeries& test) {
  std::vector<std::string> names = reference.names;
  names.insert(names.end(), test.names.begin(), test.names.end());
  for (const std::string& pattern : patterns)
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return isChosen(name, {pattern}); }))
      throw std::invalid_argument(
          fmt::format("--columns {}: neither side has such a column{}", pattern, didYouMean(pattern, names)));
}

}  // namespace

TimeSeries historyOf(const CsvTable& table) {
  const std::vector<double>& t = table.at("t_s");
  for (std::size_t k = 0; k < t.size(); ++k)
    if (!std::isfinite(t[k]) || (k > 0 && !(t[k] > t[k - 1])))
      throw CsvError(table.place(k) + ": error: t_s does not increase here, expected finite, increasing instants");
  return {table.names, table.columns};
}

Comparison compare(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                   const CurveSink& curves) {
  Comparison out;
  refuseUnknown(options.columns, reference, test);
  const std::vector<double>&t = *test.find("t_s"), &t_reference = *reference.find("t_s");
  const double rounding = options.time_tolerance + roundingOf(t_reference);
  setTimes(t_reference, t, rounding, out);
  out.skipped = skippedOf(t_reference, t, rounding);
  const std::vector<std::size_t> rows = rowsToCompare(t_reference, t, rounding, options, out);
  TimeSeries continuous = reference, aligned = test;
  compare_parts::makeContinuous(continuous);
  compare_parts::alignQuaternions(continuous, rows, aligned);
  const auto of_test = byName(aligned), of_reference = byName(reference);
  const std::map<std::string, double> scales = scalesOf(reference);
  for (std::size_t i = 0; i < reference.names.size(); ++i) {
    const std::string& name = reference.names[i];
    if (name == "t_s" || !isChosen(name, options.columns)) continue;
    const auto found = of_test.find(name);
    if (found == of_test.end()) {
      out.only_in_reference.push_back(name);
      continue;
    }
    const std::vector<double>* values = found->second;
    ChannelComparison channel;
    channel.name = name;
    const auto other = scales.find(scaleGroupOf(name));
    channel.group = other != scales.end() && other->second > 0 ? other->first : groupOf(name);
    channel.scale = scales.at(channel.group);
    channel.tolerance = options.tolerance * channel.scale;
    if (rows.empty() && out.left_out > 0) channel.verdict = Verdict::inconclusive;
    const HistoryLine line(t_reference, continuous.columns[i]);
    if (!rows.empty()) judgeRows(line, t, *values, rows, options.time_tolerance, channel);
    if (curves) curves(channel, curvesOf(line, t, *values, rows, channel.tolerance, options.time_tolerance));
    out.channels.push_back(channel);
  }
  for (const std::string& name : test.names)
    if (of_reference.count(name) == 0 && isChosen(name, options.columns)) out.only_in_test.push_back(name);
  out.verdict = verdictOf(out);
  return out;
}

}  // namespace ursula
