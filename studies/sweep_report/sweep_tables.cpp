#include "studies/sweep_report/sweep_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/quantity.h"
#include "report/sections.h"
#include "report/text.h"
#include "studies/sweep_report/sweep_words.h"

namespace ursula {
namespace {

using report::escaped;

constexpr std::size_t most_parameter_columns = 5;

std::string number(const std::string& text) { return "<td class=\"number\">" + escaped(text) + "</td>"; }

std::string head(const std::string& text, bool is_number = true) {
  return fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"number\"" : "", text);
}

std::string table(const std::string& label, const std::string& caption, const std::string& heads,
                  const std::string& rows) {
  return fmt::format(
      "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>\n<caption>{}</caption>\n<thead><tr>"
      "{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      label, caption, heads, rows);
}

/// Links to the point's row, if it has one.
std::string pointLink(const SweepSummary& summary, std::int64_t id) {
  const bool listed =
      std::any_of(summary.worst.begin(), summary.worst.end(), [id](const WorstPoint& point) { return point.id == id; });
  return listed ? fmt::format("<a href=\"#point-{0}\">{0}</a>", id) : std::to_string(id);
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

std::string badge(const std::string& verdict) {
  const Verdict shown = verdict == "pass"    ? Verdict::pass
                        : verdict == "fail"  ? Verdict::fail
                        : verdict == "error" ? Verdict::fail
                                             : Verdict::inconclusive;
  if (verdict == name(shown)) return fmt::format("<span class=\"{}\">{}</span>", verdict, report::verdictBadge(shown));
  return fmt::format("<span class=\"{}\"><span class=\"badge\">{}</span></span>", name(shown),
                     escaped(verdictWords(verdict)));
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

}  // namespace

std::string outputsTable(const SweepSummary& summary) {
  if (summary.outputs.empty()) return "";
  std::string rows;
  for (const SweepOutput& output : summary.outputs) {
    const Spread& s = output.spread;
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(titleOf(output)));
    rows += number(grouped(static_cast<std::int64_t>(s.count)));
    if (s.constant) {
      rows += number(valueOf(output, s.median)) + "<td colspan=\"7\">the same at every point</td></tr>\n";
      continue;
    }
    for (const double value : {s.min, s.low, s.median, s.high, s.max}) rows += number(valueOf(output, value));
    rows += "<td class=\"number\">" + pointLink(summary, output.worst_point) + "</td>";
    rows += number(valueOf(output, s.mean)) + number(report::quantity(s.sd, output.unit)) + "</tr>\n";
  }
  std::string heads = head("Output", false);
  for (const char* each : {"Points", "Min", "5 %", "Median", "95 %", "Max", "Worst point", "Mean", "SD"})
    heads += head(each);
  return table("Outputs",
               summary.identity.what == "validate"
                   ? "Checks as shares of their limits: up to 1 is passed. Points: those that have a value."
                   : "The largest of each motion; sin θ the smallest. Points: those that have a value.",
               heads, rows);
}

std::string worstTable(const SweepSummary& summary) {
  if (summary.worst.empty()) return "";
  const std::vector<std::size_t> shown = parametersToShow(summary);
  std::string rows;
  for (const WorstPoint& point : summary.worst) {
    rows += fmt::format(
        "<tr id=\"point-{0}\"><th scope=\"row\" class=\"number\">{0}</th><td>{1}</td><td "
        "class=\"reason\">{2}</td>",
        point.id, badge(point.verdict), escaped(whyOf(summary, point)));
    for (const std::size_t p : shown) rows += number(parameterText(summary.parameters[p], point.parameters[p]));
    rows += fmt::format("<td class=\"command\"><code>{}</code></td></tr>\n", escaped(showCommand(summary, point.id)));
  }
  std::string heads = head("Point") + head("Verdict", false) + head("Why", false);
  for (const std::size_t p : shown) heads += head("<code>" + breakable(summary.parameters[p].key) + "</code>");
  const std::size_t more = summary.parameters.size() - shown.size();
  return table(
      "Worst points",
      "Errors first, then failures, then the largest. The command writes a point’s scenario, to be looked at by "
      "itself." +
          (more > 0 ? fmt::format(" {} further numbers are in that scenario.", more) : std::string()),
      heads + head("Its scenario", false), rows);
}

std::string parametersTable(const SweepSummary& summary) {
  if (summary.points_done == 0) return "";
  std::string rows;
  for (const SweepParameter& parameter : summary.parameters) {
    rows += fmt::format("<tr><th scope=\"row\"><code>{}</code></th>", escaped(parameter.key));
    rows += number(parameter.levels > most_levels ? fmt::format("> {}", grouped(most_levels))
                                                  : grouped(static_cast<std::int64_t>(parameter.levels)));
    for (const double value : {parameter.spread.min, parameter.spread.mean, parameter.spread.max})
      rows += number(parameterText(parameter, value));
    rows += number(std::isnan(parameter.spread.sd) ? "–" : report::plainNumber(parameter.spread.sd, 3));
    rows += "</tr>\n";
  }
  std::string heads = head("Number", false);
  for (const char* each : {"Different values", "Min", "Mean", "Max", "SD"}) heads += head(each);
  const std::string all =
      table("Numbers that were varied", "The values of the points, not the requested ones.", heads, rows);
  if (summary.parameters.size() <= 12) return all;
  return fmt::format("<details class=\"group\"><summary>All {} numbers</summary>{}</details>\n",
                     summary.parameters.size(), all);
}

std::string pasteBox(const SweepSummary& summary) {
  if (summary.points_done == 0) return "";
  return fmt::format(
      "<p class=\"aside\">Markdown, for a letter or an issue.</p>\n<pre class=\"paste\" tabindex=\"0\" "
      "role=\"region\" aria-label=\"Table to paste\">{}</pre>\n",
      escaped(markdownOf(summary)));
}

}  // namespace ursula
