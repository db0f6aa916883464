#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "parts/sweep/report/sweep_outputs.h"
#include "report/page/html_template.h"
#include "report/text/quantity.h"

namespace ursula {

extern const std::string_view sweep_ties_html, sweep_drivers_html;

namespace {

using report::HtmlValue, report::listOf, report::rendered;

constexpr std::size_t most_bars = 10, most_rows = 20, most_columns = 14;

/// The content of a table of parameters by outputs, and the number of omitted ones.
struct ShownColumns {
  std::vector<std::size_t> parameters, outputs;
  std::size_t constant = 0, outputs_left_out = 0, parameters_left_out = 0;
};

/// The primary one first; then the checks nearest to their limits.
std::vector<std::size_t> outputsByWeight(const SweepSummary& summary) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < summary.outputs.size(); ++k)
    if (!summary.outputs[k].spread.constant) out.push_back(k);
  const auto weight = [&summary](std::size_t k) {
    const SweepOutput& output = summary.outputs[k];
    return output.kind == OutputKind::check_share ? -output.spread.max : -std::numeric_limits<double>::infinity();
  };
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
    return a == summary.primary ? b != summary.primary : b != summary.primary && weight(a) < weight(b);
  });
  return out;
}

/// The absolute rank correlation; 0 if there is none.
double sizeOf(const Relation& relation) { return std::isnan(relation.spearman) ? 0 : std::abs(relation.spearman); }

ShownColumns shownOf(const SweepSummary& summary) {
  ShownColumns out;
  out.outputs = outputsByWeight(summary);
  out.constant = summary.outputs.size() - out.outputs.size();
  if (out.outputs.size() > most_columns) out.outputs_left_out = out.outputs.size() - most_columns;
  out.outputs.resize(out.outputs.size() - out.outputs_left_out);
  std::vector<double> weight(summary.parameters.size());
  for (const std::size_t k : out.outputs)
    for (std::size_t p = 0; p < weight.size(); ++p) {
      const Relation& relation = summary.outputs[k].relations[p];
      weight[p] = std::max({weight[p], sizeOf(relation), strength(relation)});
    }
  out.parameters.resize(weight.size());
  std::iota(out.parameters.begin(), out.parameters.end(), std::size_t{0});
  if (weight.size() <= most_rows) return out;
  std::stable_sort(out.parameters.begin(), out.parameters.end(),
                   [&weight](std::size_t a, std::size_t b) { return weight[a] > weight[b]; });
  out.parameters_left_out = weight.size() - most_rows;
  out.parameters.resize(most_rows);
  return out;
}

std::string leftOut(const ShownColumns& shown) {
  std::string out;
  if (shown.parameters_left_out > 0)
    out += fmt::format(" The {} numbers with the weakest relations are left out.", shown.parameters_left_out);
  if (shown.outputs_left_out > 0)
    out += fmt::format(" The {} checks farthest from their limits are left out.", shown.outputs_left_out);
  if (shown.constant > 0)
    out += fmt::format(" {} the same at every point and left out.",
                       shown.constant == 1 ? "One output is" : fmt::format("{} outputs are", shown.constant));
  return out;
}

/// A number of a table of ties, in words too; `told` if it differs from chance.
HtmlValue tie(const SweepOutput& output, double value, bool told, const std::string& text) {
  return {{"output", titleOf(output)},
          {"told", told && !std::isnan(value)},
          {"minus", value < 0},
          {"depth", fmt::format("{:.0f}", 5 + 40 * std::min(1.0, std::abs(value)))},
          {"text", std::isnan(value) ? "–" : text}};
}

/// `tie_of` returns the tie of an output with a parameter.
template <class TieOf>
std::string tiesTable(const SweepSummary& summary, const ShownColumns& shown, const char* label,
                      const std::string& caption, const TieOf& tie_of, const std::vector<HtmlValue>& without = {}) {
  const auto head = [&summary](std::size_t k) { return breakable(titleOf(summary.outputs[k])); };
  const auto row = [&](std::size_t p) {
    const auto cell = [&](std::size_t k) { return tie_of(summary.outputs[k], summary.outputs[k].relations[p]); };
    return HtmlValue{{"key", keyWords(summary.parameters[p].key)}, {"cells", listOf(shown.outputs, cell)}};
  };
  return rendered(sweep_ties_html, {{"table", !shown.outputs.empty() && !shown.parameters.empty()},
                                    {"caption", caption},
                                    {"left_out", leftOut(shown)},
                                    {"label", label},
                                    {"heads", listOf(shown.outputs, head)},
                                    {"rows", listOf(shown.parameters, row)},
                                    {"without", without}});
}

/// The share of numbers acting together, if the indices are those of independent numbers.
std::string togetherWords(const SweepSummary& summary, const SweepOutput& output) {
  if (output.no_index != NoIndex::none)
    return fmt::format(" There are no first-order indices: {}.", reasonOf(output.no_index));
  if (output.spread.count != static_cast<std::size_t>(summary.points_done))
    return " The indices are over the points that have a value; there the numbers may depend on each other: their sum "
           "says nothing.";
  double sum = 0;
  for (const Relation& relation : output.relations)
    if (relation.acts) sum += relation.first_order;
  if (sum == 0) return " The effect of no single number differs from chance: more points may show it.";
  const double percent = 100 * std::min(sum, 1.0);
  return fmt::format(" Taken alone, they explain {:.0f} % of the variance{}", percent,
                     percent > 99.5
                         ? "."
                         : "; the rest comes from interactions, or from effects too small to distinguish from chance.");
}

}  // namespace

std::string driversTable(const SweepSummary& summary) {
  if (summary.primary >= summary.outputs.size()) return "";
  const SweepOutput& output = summary.outputs[summary.primary];
  if (output.spread.constant) return "";
  std::vector<std::size_t> order(summary.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Relation &of_a = output.relations[a], &of_b = output.relations[b];
    return std::pair(strength(of_a), sizeOf(of_a)) > std::pair(strength(of_b), sizeOf(of_b));
  });
  const std::string more =
      order.size() > most_bars ? fmt::format(" The strongest {} of {} numbers.", most_bars, order.size()) : "";
  order.resize(std::min(order.size(), most_bars));
  const bool has_index = output.no_index == NoIndex::none;
  const auto row = [&](std::size_t p) {
    const Relation& relation = output.relations[p];
    const double share = has_index ? relation.first_order : std::abs(relation.spearman);
    return HtmlValue{{"key", keyWords(summary.parameters[p].key)},
                     {"width", fmt::format("{:.1f}", 100 * std::clamp(share, 0.0, 1.0))},
                     {"index", shareNumber(relation.first_order)},
                     {"rank", signedNumber(relation.spearman)},
                     {"linear", signedNumber(relation.pearson)},
                     {"remark", strength(relation) > 0 ? "" : "no more than chance"}};
  };
  return rendered(sweep_drivers_html, {{"output", titleOf(output)},
                                       {"together", report::unbroken(togetherWords(summary, output))},
                                       {"more", more},
                                       {"has_index", has_index},
                                       {"rows", listOf(order, row)}}) +
         "\n";
}

std::string correlationTable(const SweepSummary& summary) {
  return tiesTable(summary, shownOf(summary), "Correlations",
                   "Rank correlations (Spearman), from −1 to +1: a deeper colour is stronger; blue rises, orange "
                   "falls. Pale numbers do not differ from chance: they are below the bound that one in a hundred "
                   "sweeps of unrelated numbers would exceed anywhere.",
                   [](const SweepOutput& output, const Relation& relation) {
                     return tie(output, relation.spearman, relation.correlates, signedNumber(relation.spearman));
                   });
}

std::string indexTable(const SweepSummary& summary) {
  ShownColumns shown = shownOf(summary);
  std::map<NoIndex, std::string> without;
  std::vector<std::size_t> with;
  for (const std::size_t k : shown.outputs) {
    const SweepOutput& output = summary.outputs[k];
    std::string& names = without[output.no_index];
    if (output.no_index == NoIndex::none) with.push_back(k);
    if (output.no_index != NoIndex::none) names += (names.empty() ? "" : ", ") + titleOf(output);
  }
  without.erase(NoIndex::none);
  const auto reason = [](const auto& each) {
    return HtmlValue{{"outputs", each.second}, {"reason", reasonOf(each.first)}};
  };
  const bool alone = with.size() == 1 && summary.outputs[with[0]].kind == OutputKind::not_passed;
  shown.outputs = alone ? std::vector<std::size_t>() : with;
  const std::string how = summary.identity.design == "grid"
                              ? "They are the exact main effects over the complete grid."
                              : "They are estimated from the given points (Plischke, Borgonovo, Smith 2013), less the "
                                "bias of finite classes. Pale numbers do not differ from chance.";
  return tiesTable(
      summary, shown, "First-order indices",
      "First-order Sobol’ indices: the share of an output’s variance that each number explains alone. " + how,
      [](const SweepOutput& output, const Relation& relation) {
        return tie(output, relation.first_order, relation.acts, shareNumber(relation.first_order));
      },
      listOf(without, reason));
}

}  // namespace ursula
