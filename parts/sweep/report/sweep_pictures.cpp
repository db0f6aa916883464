#include "parts/sweep/report/sweep_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/heat_map.h"
#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula {
namespace {

using report::escaped;

constexpr std::size_t most_histograms = 12;

std::string figure(const std::string& title, const std::string& words, const std::string& svg) {
  return fmt::format("<figure><figcaption><h3>{}</h3><p>{}</p></figcaption>{}</figure>\n", escaped(title), words, svg);
}

std::string histogramSvg(const SweepOutput& output) {
  constexpr double width = 240, height = 120, base = 100, top = 6;
  const Histogram& histogram = output.histogram;
  const std::int64_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  const double step = width / static_cast<double>(histogram.counts.size());
  std::string bars;
  for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
    if (histogram.counts[k] == 0) continue;
    const double high =
        std::max(1.0, (base - top) * static_cast<double>(histogram.counts[k]) / static_cast<double>(most));
    bars += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
                        step * static_cast<double>(k), base - high, step - 1, high);
  }
  return fmt::format(
      "<svg class=\"static bins\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"Histogram: {2} points from {3} to "
      "{4}\">{5}<path class=\"grid\" d=\"M0 {6}H{0}\"/><text x=\"0\" y=\"{7}\">{3}</text><text x=\"{0}\" y=\"{7}\" "
      "text-anchor=\"end\">{4}</text></svg>",
      width, height, output.spread.count, valueOf(output, histogram.low), valueOf(output, histogram.high), bars, base,
      height - 5);
}

std::string wordsOf(const Scatter& scatter, const Relation& relation) {
  std::string words = fmt::format("Rank correlation {}", signedNumber(relation.spearman));
  if (!std::isnan(relation.first_order))
    words += fmt::format(", first-order index {}", shareNumber(relation.first_order));
  if (scatter.x.size() < relation.count)
    words += fmt::format("; {} of {} points", grouped(static_cast<std::int64_t>(scatter.x.size())),
                         grouped(static_cast<std::int64_t>(relation.count)));
  return words;
}

report::Plot plotOf(const SweepSummary& summary, const Scatter& scatter) {
  const SweepOutput& output = summary.outputs[scatter.output];
  const std::string unit = report::prettyUnit(output.unit);
  const std::vector<std::size_t> rows = report::ascending(scatter.x);
  report::Plot plot;
  plot.x_label = keyWords(summary.parameters[scatter.parameter].key);
  plot.title = titleOf(output) + " over " + plot.x_label;
  plot.group = report::PlotGroup::relations;
  plot.y_label = titleOf(output) + (unit.empty() ? "" : " (" + unit + ")");
  plot.log_y = output.histogram.log;
  plot.rows = rows.size();
  plot.x = report::picked(scatter.x, rows);
  plot.lines = {{titleOf(output), unit, 0, report::Stroke::points, report::picked(scatter.y, rows)}};
  plot.words = wordsOf(scatter, output.relations[scatter.parameter]);
  return plot;
}

}  // namespace

std::string histograms(const SweepSummary& summary) {
  std::string out;
  std::size_t drawn = 0;
  for (const SweepOutput& output : summary.outputs) {
    if (output.histogram.counts.empty() || output.kind == OutputKind::not_passed || drawn == most_histograms) continue;
    ++drawn;
    const std::string words = fmt::format("Median {}{}", escaped(valueOf(output, output.spread.median)),
                                          output.histogram.log ? "; bins in decades" : "");
    out += figure(titleOf(output), words, histogramSvg(output));
  }
  return out.empty() ? "" : "<div class=\"charts small\">\n" + out + "</div>\n";
}

std::vector<report::Plot> scatterPlots(const SweepSummary& summary) {
  std::vector<report::Plot> out;
  for (const Scatter& scatter : summary.scatters)
    if (report::Plot plot = plotOf(summary, scatter); report::isDrawable(plot, plot.lines[0]))
      out.push_back(std::move(plot));
  return out;
}

std::string gridMaps(const SweepSummary& summary) {
  std::string out;
  for (const GridMap& map : summary.maps) {
    const SweepOutput& output = summary.outputs[map.output];
    report::HeatMap drawn{titleOf(output),
                          {keyWords(summary.parameters[0].key), map.x},
                          {keyWords(summary.parameters[1].key), map.y},
                          {map.values.begin(), map.values.end()},
                          {},
                          output.unit};
    const report::HeatScale scale(drawn.values, output.histogram.log);
    out += fmt::format(
        "<figure><svg class=\"static heat\" viewBox=\"0 30 {:.0f} {:.0f}\" role=\"img\" "
        "aria-label=\"{}\">{}</svg></figure>\n",
        report::heat_map_width, report::heat_map_height - 30, escaped(titleOf(output) + " over the two numbers"),
        report::heatMapPanel(drawn, scale, 0, 0));
  }
  if (out.empty()) return "";
  return "<p class=\"aside\">Grey: no value there, as the motion cannot be made or the point is not there.</p>\n<div "
         "class=\"charts maps\">\n" +
         out + "</div>\n";
}

}  // namespace ursula
