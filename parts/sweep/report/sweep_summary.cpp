#include "parts/sweep/report/sweep_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "parts/sweep/report/sweep_outputs.h"
#include "parts/sweep/report/sweep_rows.h"

namespace ursula {
namespace {

constexpr std::size_t fewest_for_index =
    200;  // 14 classes of 14 points; the index of unrelated numbers then scatters by 0.025
constexpr std::size_t bins = 30, most_drawn = 6, most_maps = 4, most_cells = 250'000;
constexpr double below_rounding = 1e-9;  // for an exact index

/// Different values, ascending.
std::vector<double> levelsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

class Summary {
 public:
  explicit Summary(Sqlite& database)
      : keys_(identify(database)),
        rows_(database, keys_),
        plan_(out_.identity.what == "validate", rows_.names()),
        store_(keys_.size() + plan_.outputs().size()) {}

  SweepSummary make() {
    read();
    takeOutputs();
    takeParameters();
    choosePrimary();
    relate();
    draw();
    return std::move(out_);
  }

 private:
  /// Reads the identity first, because later steps need its keys.
  const std::vector<std::string>& identify(Sqlite& database) {
    out_.identity = readIdentity(database);
    out_.identity.scenario.clear();
    return out_.identity.keys;
  }

  void read() {
    SweepRow row;
    std::vector<double> values, both;
    std::vector<double> extremes(plan_.outputs().size(), std::numeric_limits<double>::quiet_NaN());
    worst_ids_.assign(extremes.size(), -1);
    while (rows_.next(row)) {
      plan_.evaluate(row, values);
      both = row.parameters;
      both.insert(both.end(), values.begin(), values.end());
      store_.addRow(both);
      ++out_.verdicts[row.verdict];
      if (const int leg = plan_.refusedLeg(row); leg > 0) ++out_.refused_by_leg[leg - 1];
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double size = plan_.outputs()[k].kind == OutputKind::sine ? -values[k] : values[k];
        if (std::isfinite(size) && !(extremes[k] >= size)) extremes[k] = size, worst_ids_[k] = row.id;
      }
      keepWorst({row.id, row.verdict, row.error, row.parameters, scoreOf(values), plan_.largestOf(values)});
    }
    out_.points_done = static_cast<std::int64_t>(store_.rows());
  }

  /// Keeps the points to look at first: at most three errors with different texts, then failures, then the largest
  /// scores; ties by id.
  void keepWorst(const WorstPoint& point) {
    constexpr std::ptrdiff_t most_errors = 3;
    const auto isError = [](const WorstPoint& each) { return each.verdict == "error"; };
    const auto place = [&isError](const WorstPoint& each) {
      const double score =
          isError(each) || std::isnan(each.score) ? -std::numeric_limits<double>::infinity() : each.score;
      return std::tuple(!isError(each), each.verdict != "fail", -score, each.id);
    };
    std::vector<WorstPoint>& worst = out_.worst;
    const auto says = [&](const WorstPoint& each) { return isError(each) && each.error == point.error; };
    if (isError(point) && (std::count_if(worst.begin(), worst.end(), isError) == most_errors ||
                           std::any_of(worst.begin(), worst.end(), says)))
      return;
    const auto isWorse = [&](const WorstPoint& a, const WorstPoint& b) { return place(a) < place(b); };
    worst.insert(std::upper_bound(worst.begin(), worst.end(), point, isWorse), point);
    if (worst.size() > most_worst) worst.pop_back();
  }

  double scoreOf(const std::vector<double>& values) const {
    const OutputKind kind = plan_.outputs().front().kind;
    return kind == OutputKind::not_passed ? std::numeric_limits<double>::quiet_NaN() : values.front();
  }

  /// Keeps the outputs with values, and the ranks of the values.
  void takeOutputs() {
    std::vector<std::size_t> taken(plan_.outputs().size());
    for (std::size_t k = 0; k < plan_.outputs().size(); ++k) {
      const std::vector<double> values = store_.column(keys_.size() + k);
      SweepOutput output = plan_.outputs()[k];
      output.spread = spreadOf(values);
      taken[k] = out_.outputs.size();
      if (output.spread.count == 0 || (output.kind == OutputKind::not_passed && output.spread.constant)) continue;
      output.histogram = histogramOf(values, output.spread, bins);
      output.worst_point = worst_ids_[k];
      out_.outputs.push_back(output);
      columns_.push_back({keys_.size() + k, output.spread.constant ? 0 : store_.addColumn(ranksOf(values))});
    }
    for (WorstPoint& point : out_.worst) point.because = taken[point.because];
  }

  void takeParameters() {
    for (std::size_t p = 0; p < keys_.size(); ++p) {
      const std::vector<double> x = store_.column(p);
      std::vector<double> levels = levelsOf(x);
      out_.parameters.push_back({keys_[p], spreadOf(x), std::min(levels.size(), most_levels + 1)});
      if (levels.size() > most_levels) levels.clear();
      levels_.push_back(std::move(levels));
    }
  }

  /// Whether every combination of the levels exists once.
  bool isCompleteGrid() const {
    if (out_.identity.design != "grid" || out_.points_done != out_.identity.points) return false;
    double combinations = 1;
    for (const SweepParameter& parameter : out_.parameters) combinations *= static_cast<double>(parameter.levels);
    return combinations == static_cast<double>(store_.rows());
  }

  NoIndex noIndex(const SweepOutput& output, bool complete) const {
    if (output.spread.constant) return NoIndex::constant;
    if (out_.identity.design == "grid")
      return complete && output.spread.count == store_.rows() ? NoIndex::none : NoIndex::grid_not_complete;
    return output.spread.count < fewest_for_index ? NoIndex::too_few : NoIndex::none;
  }

  void relate() {
    const bool complete = isCompleteGrid();
    for (SweepOutput& output : out_.outputs) {
      output.no_index = noIndex(output, complete);
      if (!output.spread.constant) out_.pairs += out_.parameters.size();
    }
    const Classes classes = out_.identity.design == "grid"    ? Classes::levels
                            : out_.identity.design == "sobol" ? Classes::strata
                                                              : Classes::quantiles;
    for (std::size_t p = 0; p < keys_.size(); ++p) {
      SweptValues parameter;
      parameter.x = store_.column(p);
      parameter.order = orderOf(parameter.x);
      for (std::size_t k = 0; k < out_.outputs.size(); ++k)
        out_.outputs[k].relations.push_back(related(parameter, k, classes));
    }
  }

  Relation related(const SweptValues& parameter, std::size_t k, Classes classes) {
    const SweepOutput& output = out_.outputs[k];
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (output.spread.constant) return {none, none, none, 0, output.spread.count, false, false};
    Relation out = relationOf(parameter, store_.column(columns_[k].values), store_.column(columns_[k].ranks), classes,
                              output.no_index == NoIndex::none);
    const double alpha = 0.01 / static_cast<double>(out_.pairs);
    const auto [bound, is_new] = bounds_.try_emplace({out.count, out.classes});
    if (is_new)
      bound->second = {correlationBound(out.count, alpha),
                       classes == Classes::levels
                           ? below_rounding
                           : indexBound(out.count, out.classes, alpha, classes == Classes::quantiles)};
    out.correlates = std::max(std::abs(out.pearson), std::abs(out.spearman)) > bound->second.first;
    out.acts = out.first_order > bound->second.second;
    return out;
  }

  void choosePrimary() {
    const auto first = std::find_if(out_.outputs.begin(), out_.outputs.end(),
                                    [](const SweepOutput& each) { return each.kind != OutputKind::not_passed; });
    out_.primary = first - out_.outputs.begin();
    if (first == out_.outputs.end()) out_.primary = out_.outputs.size();
    double nearest = -1;
    for (std::size_t k = 0; k < out_.outputs.size(); ++k)
      if (out_.outputs[k].kind == OutputKind::check_share && out_.outputs[k].spread.max > nearest)
        nearest = out_.outputs[k].spread.max, out_.primary = k;
  }

  void draw() {
    out_.scatters = pairsToDraw(out_, most_drawn);
    const std::vector<std::size_t> rows = rowsToDraw(store_.rows());
    for (Scatter& scatter : out_.scatters) {
      const std::vector<double> x = store_.column(scatter.parameter);
      const std::vector<double> y = store_.column(columns_[scatter.output].values);
      for (const std::size_t row : rows)
        if (std::isfinite(y[row])) scatter.x.push_back(x[row]), scatter.y.push_back(y[row]);
    }
    if (out_.identity.design != "grid" || keys_.size() != 2) return;
    if (levels_[0].size() < 2 || levels_[1].size() < 2 || levels_[0].size() * levels_[1].size() > most_cells) return;
    const std::vector<double> x = store_.column(0), y = store_.column(1);
    for (const std::size_t k : outputsToMap(out_, most_maps))
      out_.maps.push_back(
          {k, levels_[0], levels_[1], onGrid(levels_[0], levels_[1], x, y, store_.column(columns_[k].values))});
  }

  struct Columns {
    std::size_t values, ranks;  ///< ranks exist only for outputs that vary
  };

  SweepSummary out_;
  const std::vector<std::string>& keys_;
  SweepRows rows_;
  OutputPlan plan_;
  ColumnStore store_;
  std::vector<std::int64_t> worst_ids_;      ///< per output of the plan
  std::vector<Columns> columns_;             ///< per output of the summary
  std::vector<std::vector<double>> levels_;  ///< per parameter; empty if there are too many
  /// Bounds of correlation and index, by numbers of rows and classes.
  std::map<std::pair<std::size_t, std::size_t>, std::pair<double, double>> bounds_;
};

}  // namespace

SweepSummary summarise(Sqlite& database) { return Summary(database).make(); }

double strength(const Relation& relation) {
  const double by_rank = relation.correlates ? std::abs(relation.spearman) : 0;
  return relation.acts ? std::max(by_rank, std::sqrt(relation.first_order)) : by_rank;
}

std::size_t driver(const SweepOutput& output) {
  std::size_t best = output.relations.size();
  double most = 0;
  for (std::size_t p = 0; p < output.relations.size(); ++p)
    if (const double s = strength(output.relations[p]); s > most) most = s, best = p;
  return best;
}

}  // namespace ursula
