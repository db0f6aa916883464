#include "validation/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "model/csv.h"

namespace ursula {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const char* const work_group = "tau_*_Nm x phi_*_rad";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// `tau_3_Nm` → `tau_*_Nm`: what shares a unit and a meaning shares a scale.
std::string groupOf(const std::string& channel) {
  std::stringstream in(channel);
  std::string out, part;
  while (std::getline(in, part, '_')) {
    const bool is_index = part.size() == 1 && std::string("123456wxyz").find(part) != std::string::npos;
    // The first part is the quantity: the "w" of an angular velocity is none of its indices.
    out += (out.empty() ? "" : "_") + (is_index && !out.empty() ? "*" : part);
  }
  return out;
}

/// What an error is an error of: its own size is rounding, and no scale.
std::string scaleGroupOf(const std::string& channel) {
  static const std::map<std::string, std::string> of = {
      {"error_p_m", "p_*_m"},
      {"closure_p_m", "p_*_m"},
      {"error_q_rad", "q_*"},
      {"closure_v_m_s", "v_*_m_s"},
      {"error_tau_Nm", "tau_*_Nm"},
      {"limit_tau_Nm", "tau_*_Nm"},
      {"error_acceleration_m_s2", "a_*_m_s2"},
      {"limit_acceleration_m_s2", "a_*_m_s2"},
      {"error_energy_J", work_group},
  };
  const auto found = of.find(channel);
  return found == of.end() ? groupOf(channel) : found->second;
}

/// Largest finite magnitude of every group; of energy errors, that of the work: torques times angles.
std::map<std::string, double> scalesOf(const TimeSeries& series) {
  std::map<std::string, double> scales;
  for (std::size_t i = 0; i < series.names.size(); ++i) {
    double& scale = scales[groupOf(series.names[i])];
    for (double value : series.columns[i])
      if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  }
  if (scales.count("tau_*_Nm") != 0 && scales.count("phi_*_rad") != 0)
    scales[work_group] = scales["tau_*_Nm"] * scales["phi_*_rad"];
  return scales;
}

/// A history with straight lines between its instants.
class Polyline {
 public:
  Polyline(const std::vector<double>& t, const std::vector<double>& values) : t_(t), values_(values) {}

  double at(double t) const {
    const std::size_t i = before(t);
    if (i + 1 == t_.size()) return values_[i];
    const double s = std::clamp((t - t_[i]) / (t_[i + 1] - t_[i]), 0.0, 1.0);
    if (s == 0) return values_[i];
    return s == 1 ? values_[i + 1] : (1 - s) * values_[i] + s * values_[i + 1];
  }

  /// Distance of `value` from the range of the line over [from, to]; NaN where the line or the value is.
  double distance(double value, double from, double to) const {
    double low = at(from), high = low;
    const auto include = [&](double found) {
      low = std::isnan(found) || std::isnan(low) ? nan : std::min(low, found);
      high = std::isnan(low) ? nan : std::max(high, found);
    };
    include(at(to));
    for (std::size_t i = before(from) + 1; i < t_.size() && t_[i] < to; ++i) include(values_[i]);
    if (std::isnan(low) || std::isnan(value)) return nan;
    if (value >= low && value <= high) return 0;
    return value < low ? low - value : value - high;
  }

  /// What the chord at t may miss: h²/8 times the larger second derivative beside it, doubled since that is estimated.
  double chordError(double t) const {
    const std::size_t i = before(t);
    if (i + 1 == t_.size() || t_.size() < 3) return 0;
    const double h = t_[i + 1] - t_[i];
    double bend = 0;
    for (std::size_t k = std::max<std::size_t>(i, 1); k <= i + 1 && k + 1 < t_.size(); ++k) {
      const double left = (values_[k] - values_[k - 1]) / (t_[k] - t_[k - 1]);
      const double right = (values_[k + 1] - values_[k]) / (t_[k + 1] - t_[k]);
      bend = std::max(bend, std::abs(2 * (right - left) / (t_[k + 1] - t_[k - 1])));
    }
    return 2 * bend * h * h / 8;
  }

  bool isKnot(double t) const {
    const std::size_t i = before(t);
    const double rounding = 4 * eps * std::abs(t);
    return std::abs(t - t_[i]) <= rounding || (i + 1 < t_.size() && std::abs(t_[i + 1] - t) <= rounding);
  }

 private:
  std::size_t before(double t) const {
    const auto after = std::upper_bound(t_.begin(), t_.end(), t) - t_.begin();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
  }

  const std::vector<double>& t_;
  const std::vector<double>& values_;
};

double larger(double a, double b) { return std::isnan(a) || std::isnan(b) ? nan : std::max(a, b); }

/// Errors at the test's instants `rows`, and how far they leave the tube.
void judgeRows(const Polyline& reference, const std::vector<double>& t, const std::vector<double>& values,
               const std::vector<std::size_t>& rows, double time_tolerance, ChannelComparison& out) {
  double squares = 0;
  bool exceeds_chord = false;
  for (const std::size_t k : rows) {
    const double error = std::abs(values[k] - reference.at(t[k]));
    const double distance = reference.distance(values[k], t[k] - time_tolerance, t[k] + time_tolerance);
    const double chord = reference.isKnot(t[k]) ? 0 : reference.chordError(t[k]);
    if (error > out.max_error || k == rows.front() || std::isnan(error)) out.max_at = t[k];
    out.max_error = larger(out.max_error, error);
    out.outside = larger(out.outside, distance);
    out.interpolation = std::max(out.interpolation, chord);
    out.final_error = error;
    squares += error * error;
    if (!(distance <= out.tolerance + chord)) exceeds_chord = true;
    if (std::isnan(error)) break;
  }
  out.rms_error = std::sqrt(squares / static_cast<double>(rows.size()));
  if (std::isnan(out.max_error)) out.final_error = out.rms_error = nan;
  if (out.outside <= out.tolerance)
    out.verdict = Verdict::pass;
  else
    out.verdict = exceeds_chord || rows.empty() ? Verdict::fail : Verdict::inconclusive;
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

/// Instants of the reference that the test passes over: where it is less than a third as dense.
std::size_t skippedOf(const std::vector<double>& reference, const std::vector<double>& test, double rounding) {
  std::size_t skipped = 0;
  for (std::size_t k = 0; k + 1 < test.size(); ++k) {
    const auto first = std::upper_bound(reference.begin(), reference.end(), test[k] + rounding);
    const auto last = std::lower_bound(first, reference.end(), test[k + 1] - rounding);
    if (last - first >= 3) skipped += static_cast<std::size_t>(last - first);
  }
  return skipped;
}

Verdict verdictOf(const Comparison& comparison) {
  if (comparison.channels.empty() || comparison.instants == 0) return Verdict::fail;
  bool is_whole = comparison.only_in_reference.empty() && comparison.covers_reference && comparison.skipped == 0;
  for (const ChannelComparison& channel : comparison.channels) {
    if (channel.verdict == Verdict::fail) return Verdict::fail;
    is_whole = is_whole && channel.verdict == Verdict::pass;
  }
  return is_whole ? Verdict::pass : Verdict::inconclusive;
}

}  // namespace

TimeSeries readHistory(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(file_or_folder, ignored);
  const CsvTable table = readCsv(is_folder ? file_or_folder / "timeseries.csv" : file_or_folder, {{}, false});
  const std::vector<double>& t = table.at("t_s");
  for (std::size_t k = 0; k < t.size(); ++k)
    if (!std::isfinite(t[k]) || (k > 0 && !(t[k] > t[k - 1])))
      throw CsvError(table.place(k) + ": error: t_s does not increase here, expected finite, increasing instants");
  return {table.names, table.columns};
}

Comparison compare(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options) {
  Comparison out;
  const std::vector<double>&t = *test.find("t_s"), &t_reference = *reference.find("t_s");
  const double rounding = options.time_tolerance + 4 * eps * std::max(std::abs(t_reference.back()), std::abs(t.back()));
  setTimes(t_reference, t, rounding, out);
  out.skipped = skippedOf(t_reference, t, rounding);
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] >= t_reference.front() - rounding && t[k] <= t_reference.back() + rounding) rows.push_back(k);
  out.instants = rows.size();
  const Polyline times(t_reference, t_reference);
  for (const std::size_t k : rows) out.interpolated += times.isKnot(t[k]) ? 0 : 1;
  const std::map<std::string, double> scales = scalesOf(reference);
  for (std::size_t i = 0; i < reference.names.size(); ++i) {
    const std::string& name = reference.names[i];
    if (name == "t_s") continue;
    const std::vector<double>* values = test.find(name);
    if (values == nullptr) {
      out.only_in_reference.push_back(name);
      continue;
    }
    ChannelComparison channel;
    channel.name = name;
    channel.group = scales.count(scaleGroupOf(name)) != 0 ? scaleGroupOf(name) : groupOf(name);
    channel.scale = scales.at(channel.group);
    channel.tolerance = options.tolerance * channel.scale;
    if (!rows.empty())
      judgeRows(Polyline(t_reference, reference.columns[i]), t, *values, rows, options.time_tolerance, channel);
    out.channels.push_back(channel);
  }
  for (const std::string& name : test.names)
    if (reference.find(name) == nullptr) out.only_in_test.push_back(name);
  out.verdict = verdictOf(out);
  return out;
}

}  // namespace ursula
