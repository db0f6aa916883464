#include "parts/sweep/report/relations.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "parts/sweep/report/sweep_outputs.h"

namespace ursula {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Whether least and largest differ only by rounding.
bool isConstant(double min, double max) {
  return !(max - min > 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(min), std::abs(max)));
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Σ (v − mean)²
double squaresAbout(const std::vector<double>& values, double mean) {
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [mean](double sum, double v) { return sum + (v - mean) * (v - mean); });
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = meanOf(a), mean_b = meanOf(b);
  double products = 0;
  for (std::size_t k = 0; k < a.size(); ++k) products += (a[k] - mean_a) * (b[k] - mean_b);
  return std::clamp(products / std::sqrt(squaresAbout(a, mean_a) * squaresAbout(b, mean_b)), -1.0, 1.0);
}

/// Ranks of sorted values, with mean ranks for ties.
std::vector<double> sortedRanks(const std::vector<double>& sorted) {
  std::vector<double> out(sorted.size());
  for (std::size_t from = 0, to = 0; from < sorted.size(); from = to) {
    while (to < sorted.size() && sorted[to] == sorted[from]) ++to;
    std::fill(&out[from], out.data() + to, 0.5 * static_cast<double>(from + to + 1));
  }
  return out;
}

/// The end of each class of sorted x.
std::vector<std::size_t> endsOf(const std::vector<double>& x, Classes classes) {
  const auto rows = static_cast<double>(x.size());
  const double count = std::round(classes == Classes::strata ? std::cbrt(rows) : std::sqrt(rows));
  std::vector<std::size_t> ends;
  for (std::size_t k = 1; k <= x.size(); ++k) {
    const double filled = static_cast<double>(k) * count, wanted = static_cast<double>((ends.size() + 1) * x.size());
    if (k == x.size() || (x[k] != x[k - 1] && (classes == Classes::levels || filled >= wanted))) ends.push_back(k);
  }
  return ends;
}

void addIndex(const std::vector<double>& x, const std::vector<double>& y, Classes classes, Relation& out) {
  const std::vector<std::size_t> ends = endsOf(x, classes);
  out.classes = ends.size();
  if (ends.size() < 2 || (classes != Classes::levels && ends.size() >= y.size())) return;
  const double mean = meanOf(y), total = squaresAbout(y, mean);
  double between = 0;
  std::size_t from = 0;
  for (const std::size_t to : ends) {
    const auto members = static_cast<double>(to - from);
    const double off = std::accumulate(&y[from], y.data() + to, 0.0) / members - mean;
    between += members * off * off;
    from = to;
  }
  const auto groups = static_cast<double>(ends.size()), rows = static_cast<double>(y.size());
  const double chance = classes == Classes::quantiles ? (groups - 1) * (total - between) / (rows - groups) : 0;
  out.first_order = (between - chance) / total;
}

}  // namespace

Spread spreadOf(const std::vector<double>& values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  if (sorted.empty()) return {0, none, none, none, none, none, none, none, true};
  std::sort(sorted.begin(), sorted.end());
  Spread out;
  out.count = sorted.size();
  out.min = sorted.front(), out.max = sorted.back();
  out.low = quantile(sorted, 0.05), out.median = quantile(sorted, 0.5), out.high = quantile(sorted, 0.95);
  out.constant = isConstant(out.min, out.max);
  out.mean = meanOf(sorted);
  out.sd = out.count < 2 ? none : std::sqrt(squaresAbout(sorted, out.mean) / static_cast<double>(out.count - 1));
  return out;
}

Histogram histogramOf(const std::vector<double>& values, const Spread& spread, std::size_t bins) {
  Histogram out;
  if (spread.count == 0 || spread.constant) return out;
  out.low = spread.min, out.high = spread.max;
  out.log = spread.min > 0 && spread.max > 1000 * spread.min;
  out.counts.assign(bins, 0);
  const auto drawn = [&out](double v) { return out.log ? std::log(v) : v; };
  const double from = drawn(out.low), width = (drawn(out.high) - from) / static_cast<double>(bins);
  for (const double v : values)
    if (std::isfinite(v)) ++out.counts[std::min(bins - 1, static_cast<std::size_t>((drawn(v) - from) / width))];
  return out;
}

std::vector<std::uint32_t> orderOf(const std::vector<double>& values) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&values](std::uint32_t a, std::uint32_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  return order;
}

std::vector<double> ranksOf(const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values)
    if (std::isfinite(v)) finite.push_back(v);
  const std::vector<std::uint32_t> order = orderOf(finite);
  std::vector<double> sorted(finite.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = finite[order[k]];
  const std::vector<double> ranks = sortedRanks(sorted);
  for (std::size_t k = 0; k < order.size(); ++k) finite[order[k]] = ranks[k];
  std::vector<double> out(values.size(), none);
  for (std::size_t k = 0, next = 0; k < values.size(); ++k)
    if (std::isfinite(values[k])) out[k] = finite[next++];
  return out;
}

Relation relationOf(const SweptValues& parameter, const std::vector<double>& y, const std::vector<double>& y_ranks,
                    Classes classes, bool wants_index) {
  std::vector<double> x_kept, y_kept, ranks_kept;
  for (const std::uint32_t row : parameter.order) {
    if (!std::isfinite(y[row])) continue;
    x_kept.push_back(parameter.x[row]);
    y_kept.push_back(y[row]);
    ranks_kept.push_back(y_ranks[row]);
  }
  Relation out{none, none, none, 0, y_kept.size(), false, false};
  if (y_kept.size() < 3 || isConstant(x_kept.front(), x_kept.back())) return out;
  const auto [least, most] = std::minmax_element(y_kept.begin(), y_kept.end());
  if (isConstant(*least, *most)) return out;
  out.pearson = correlation(x_kept, y_kept);
  out.spearman = correlation(sortedRanks(x_kept), ranks_kept);
  if (wants_index) addIndex(x_kept, y_kept, classes, out);
  return out;
}

double correlationBound(std::size_t count, double alpha) {
  if (count < 3) return 1;
  const auto freedom = static_cast<double>(count - 2);
  const double t = boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), alpha / 2));
  return t / std::sqrt(freedom + t * t);
}

double indexBound(std::size_t count, std::size_t classes, double alpha, bool corrected) {
  if (classes < 2 || count <= classes) return 1;
  const auto between = static_cast<double>(classes - 1), within = static_cast<double>(count - classes);
  const double f = boost::math::quantile(boost::math::complement(boost::math::fisher_f(between, within), alpha));
  // ε² = (S_b − (M − 1) s²) / (S_b + S_w), S_b = (M − 1) F s², S_w = (n − M) s²
  return between * (corrected ? f - 1 : f) / (between * f + within);
}

namespace {

/// Whether a scatter plot of the output says something: one with two values does not, and each check has its own plot.
bool saysMore(OutputKind kind) { return kind != OutputKind::not_passed && kind != OutputKind::largest_share; }

}  // namespace

std::vector<Scatter> pairsToDraw(const SweepSummary& summary, std::size_t most) {
  const auto strengthOf = [&summary](const Scatter& pair) {
    return strength(summary.outputs[pair.output].relations[pair.parameter]);
  };
  std::vector<Scatter> pairs;
  for (std::size_t k = 0; k < summary.outputs.size(); ++k)
    for (std::size_t p = 0; p < summary.parameters.size(); ++p)
      if (const Scatter pair{p, k, {}, {}}; strengthOf(pair) > 0 && saysMore(summary.outputs[k].kind))
        pairs.push_back(pair);
  std::stable_sort(pairs.begin(), pairs.end(), [&](const Scatter& a, const Scatter& b) {
    const bool first_a = a.output == summary.primary, first_b = b.output == summary.primary;
    return first_a != first_b ? first_a : strengthOf(a) > strengthOf(b);
  });
  std::vector<std::size_t> of_parameter(summary.parameters.size()), of_output(summary.outputs.size());
  std::vector<Scatter> out;
  for (const Scatter& pair : pairs) {
    const std::size_t outputs = pair.output == summary.primary ? 2 : 1;
    if (of_output[pair.output] >= outputs || of_parameter[pair.parameter] >= 2) continue;
    ++of_output[pair.output], ++of_parameter[pair.parameter];
    out.push_back(pair);
    if (out.size() == most) break;
  }
  return out;
}

std::vector<std::size_t> rowsToDraw(std::size_t rows) {
  constexpr double golden = 0.6180339887498949;
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < std::min(rows, most_scattered); ++k) {
    const double at = golden * static_cast<double>(k);
    out.push_back(rows <= most_scattered ? k
                                         : static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(rows)));
  }
  return out;
}

std::vector<std::size_t> outputsToMap(const SweepSummary& summary, std::size_t most) {
  std::vector<std::size_t> out;
  const auto add = [&](auto wanted) {
    for (std::size_t k = 0; k < summary.outputs.size(); ++k)
      if (wanted(summary.outputs[k].kind) && !summary.outputs[k].spread.constant && out.size() < most) out.push_back(k);
  };
  add([](OutputKind kind) { return kind == OutputKind::largest_effort || kind == OutputKind::largest_share; });
  if (summary.primary < summary.outputs.size() && !summary.outputs[summary.primary].spread.constant &&
      std::find(out.begin(), out.end(), summary.primary) == out.end())
    out.push_back(summary.primary);
  add([](OutputKind kind) {
    return kind == OutputKind::kappa || kind == OutputKind::sine || kind == OutputKind::other;
  });
  return out;
}

std::vector<double> onGrid(const std::vector<double>& x_levels, const std::vector<double>& y_levels,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& values) {
  std::vector<double> out(x_levels.size() * y_levels.size(), std::numeric_limits<double>::quiet_NaN());
  const auto place = [](const std::vector<double>& levels, double value) {
    return std::lower_bound(levels.begin(), levels.end(), value) - levels.begin();
  };
  for (std::size_t k = 0; k < values.size(); ++k)
    out[place(y_levels, y[k]) * x_levels.size() + place(x_levels, x[k])] = values[k];
  return out;
}

}  // namespace ursula
