#include "parts/sweep/report/sweep_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/page/html_template.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula {

extern const std::string_view sweep_outputs_html, sweep_worst_html, sweep_parameters_html, sweep_paste_html;

namespace {

using report::HtmlValue, report::listOf, report::rendered;

constexpr std::size_t most_parameter_columns = 5;

bool hasRow(const SweepSummary& summary, std::int64_t id) {
  return std::any_of(summary.worst.begin(), summary.worst.end(),
                     [id](const WorstPoint& point) { return point.id == id; });
}

/// The parameters that drive the primary output most; all if they are few.
std::vector<std::size_t> parametersToShow(const SweepSummary& summary) {
  std::vector<std::size_t> order(summary.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (order.size() <= most_parameter_columns) return order;
  if (summary.primary < summary.outputs.size()) {
    const std::vector<Relation>& relations = summary.outputs[summary.primary].relations;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strength(relations[a]) > strength(relations[b]); });
  }
  order.resize(most_parameter_columns);
  return order;
}

std::string parameterText(const SweepParameter& parameter, double value) {
  const Spread& all = parameter.spread;
  const bool is_zero = std::abs(value) < 1e-9 * (all.max - all.min);  // relative to the other values
  return report::plainNumber(is_zero ? 0 : value, 1 + report::digitsToTell(all.min, all.max));
}

Verdict shownVerdict(const std::string& verdict) {
  return verdict == "pass"                         ? Verdict::pass
         : verdict == "fail" || verdict == "error" ? Verdict::fail
                                                   : Verdict::inconclusive;
}

/// Says why the point is one of the worst.
std::string whyOf(const SweepSummary& summary, const WorstPoint& point) {
  if (!point.error.empty()) return point.error;
  if (std::isnan(point.score) || point.because >= summary.outputs.size()) return "";
  const SweepOutput& output = summary.outputs[point.because];
  if (output.kind == OutputKind::effort)
    return fmt::format("{}, motor {}", valueOf(output, point.score), output.motor + 1);
  return fmt::format("{}: {}", titleOf(output), saidOf(output, point.score));
}

HtmlValue outputRow(const SweepSummary& summary, const SweepOutput& output) {
  const Spread& s = output.spread;
  const auto text = [&output](double value) { return valueOf(output, value); };
  return {{"title", titleOf(output)},
          {"points", grouped(static_cast<std::int64_t>(s.count))},
          {"constant", s.constant},
          {"min", text(s.min)},
          {"low", text(s.low)},
          {"median", text(s.median)},
          {"high", text(s.high)},
          {"max", text(s.max)},
          {"listed", hasRow(summary, output.worst_point)},
          {"worst", output.worst_point},
          {"mean", text(s.mean)},
          {"sd", report::quantity(s.sd, output.unit)}};
}

HtmlValue worstRow(const SweepSummary& summary, const WorstPoint& point, const std::vector<std::size_t>& shown) {
  const Verdict verdict = shownVerdict(point.verdict);
  const bool judges = summary.identity.what == "validate";
  const auto value = [&](std::size_t p) {
    const SweepParameter& parameter = summary.parameters[p];
    return HtmlValue{{"key", keyWords(parameter.key)}, {"value", parameterText(parameter, point.parameters[p])}};
  };
  return {{"id", point.id},
          {"verdict", name(verdict)},
          {"badge", judges && point.verdict == name(verdict) ? report::verdictBadge(verdict) : ""},
          {"words", verdictWords(point.verdict, judges)},
          {"why", whyOf(summary, point)},
          {"values", listOf(shown, value)},
          {"command", showCommand(summary, point.id)}};
}

HtmlValue parameterRow(const SweepParameter& parameter) {
  const Spread& s = parameter.spread;
  return {{"key", parameter.key},
          {"words", keyWords(parameter.key)},
          {"levels", parameter.levels > most_levels ? fmt::format("> {}", grouped(most_levels))
                                                    : grouped(static_cast<std::int64_t>(parameter.levels))},
          {"min", parameterText(parameter, s.min)},
          {"mean", parameterText(parameter, s.mean)},
          {"max", parameterText(parameter, s.max)},
          {"sd", std::isnan(s.sd) ? "–" : report::plainNumber(s.sd, 3)}};
}

}  // namespace

std::string outputsTable(const SweepSummary& summary) {
  if (summary.outputs.empty()) return "";
  const auto row = [&summary](const SweepOutput& output) { return outputRow(summary, output); };
  return rendered(sweep_outputs_html,
                  {{"validates", summary.identity.what == "validate"}, {"rows", listOf(summary.outputs, row)}}) +
         "\n";
}

std::string worstTable(const SweepSummary& summary) {
  if (summary.worst.empty()) return "";
  const std::vector<std::size_t> shown = parametersToShow(summary);
  const std::size_t more = summary.parameters.size() - shown.size();
  const auto key = [&summary](std::size_t p) { return report::escaped(keyWords(summary.parameters[p].key)); };
  const auto row = [&](const WorstPoint& point) { return worstRow(summary, point, shown); };
  return rendered(sweep_worst_html, {{"more", more > 0 ? std::to_string(more) : ""},
                                     {"keys", listOf(shown, key)},
                                     {"rows", listOf(summary.worst, row)}}) +
         "\n";
}

std::string parametersTable(const SweepSummary& summary) {
  if (summary.points_done == 0) return "";
  return rendered(sweep_parameters_html, {{"folded", summary.parameters.size() > 12},
                                          {"count", summary.parameters.size()},
                                          {"rows", listOf(summary.parameters, parameterRow)}});
}

std::string pasteBox(const SweepSummary& summary) {
  if (summary.points_done == 0) return "";
  return rendered(sweep_paste_html, {{"markdown", markdownOf(summary)}}) + "\n";
}

}  // namespace ursula
