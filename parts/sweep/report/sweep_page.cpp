#include "parts/sweep/report/sweep_outputs.h"

#include <fmt/format.h>

#include "report/page/page.h"
#include "report/text/text.h"

namespace ursula {
namespace {

constexpr const char* style = R"(
.small{grid-template-columns:repeat(auto-fill,minmax(min(14rem,100%),1fr))}
.maps{grid-template-columns:repeat(auto-fit,minmax(min(24rem,100%),32rem))}
.bins rect{fill:var(--bar)}
.heat .title{fill:var(--text);font-size:13px}
.heat .frame{fill:none;stroke:var(--quiet)}
.ties,.drivers{width:auto}
.ties thead th,#worst thead th{max-width:8rem;white-space:normal;vertical-align:bottom}
.ties .tie{background:color-mix(in srgb,var(--c0) var(--depth),var(--panel))}
.ties .minus{background:color-mix(in srgb,var(--c1) var(--depth),var(--panel))}
.ties .none{color:var(--quiet)}
.drivers .bars{width:14rem;min-width:6rem}
.ties code,.drivers code,td code{white-space:nowrap}
thead code{overflow-wrap:normal}
.reason{min-width:14rem}
#worst .command{min-width:15rem}
#worst .command code{white-space:normal}
.small{margin-bottom:1rem}
tr:target{background:var(--panel)}
.paste{overflow-x:auto;padding:.6rem;background:var(--panel)}
)";

std::string designWords(const SweepIdentity& identity) {
  if (identity.design == "grid") return "a grid";
  return identity.design == "sobol" ? "a Sobol’ sequence" : identity.design + " points";
}

bool isWhole(const SweepSummary& summary) {
  return summary.identity.shards == 1 && summary.points_done >= summary.identity.points;
}

/// Returns the page's verdict. Without failed points a sweep of `inverse` has none, because efforts are not judged.
Verdict verdictOf(const SweepSummary& summary) {
  const auto has = [&summary](const char* verdict) { return summary.verdicts.count(verdict) > 0; };
  if (has("fail") || has("error")) return Verdict::fail;
  if (summary.identity.what != "validate" || summary.points_done == 0) return Verdict::not_applicable;
  const bool all_passed = summary.verdicts.size() == 1 && has("pass");
  return all_passed && isWhole(summary) ? Verdict::pass : Verdict::inconclusive;
}

std::string sizeOf(const SweepSummary& summary) {
  const std::size_t count = summary.identity.keys.size();
  return fmt::format("{} {}", count, count == 1 ? "number" : "numbers");
}

std::vector<report::PageFigure> figuresOf(const SweepSummary& summary) {
  std::vector<report::PageFigure> out;
  out.push_back({"Varied", sizeOf(summary), "on " + designWords(summary.identity)});
  out.push_back({isWhole(summary) ? "Points" : "Points, incomplete", grouped(summary.points_done),
                 "of " + grouped(summary.identity.points)});
  for (const char* verdict : {"pass", "fail", "error", "inconclusive", "out_of_reach", "singular"})
    if (const auto at = summary.verdicts.find(verdict); at != summary.verdicts.end())
      out.push_back({verdictWords(verdict, summary.identity.what == "validate"), grouped(at->second),
                     fmt::format("{:.3g} %",
                                 100.0 * static_cast<double>(at->second) / static_cast<double>(summary.points_done))});
  if (summary.primary >= summary.outputs.size()) return out;
  const SweepOutput& output = summary.outputs[summary.primary];
  out.push_back({titleOf(output), valueOf(output, output.spread.max),
                 fmt::format("{}at point {}", output.kind == OutputKind::check_share ? "of its limit " : "",
                             output.worst_point)});
  return out;
}

}  // namespace

std::string sweepPage(const SweepSummary& summary) {
  const SweepIdentity& identity = summary.identity;
  report::Page page;
  page.kind = "Sweep";
  page.title = identity.name;
  page.subtitle = fmt::format("{}: {} varied on {}, {}", identity.file, sizeOf(summary), designWords(identity),
                              identity.what == "validate"
                                  ? std::string("each point validated") + (identity.pointwise ? " pointwise" : "")
                                  : "the largest efforts of each point");
  page.verdict = verdictOf(summary);
  page.sentence = sweepSentence(summary);
  page.remarks = sweepRemarks(summary);
  page.figures = figuresOf(summary);
  page.style = style;
  page.charts = scatterPlots(summary);
  if (!page.charts.empty()) page.script = report::charts_script;
  page.sections = {{"maps", "Over the grid", gridMaps(summary)},
                   {"drivers", "Drivers", driversTable(summary)},
                   {"scatter", "Strongest relations", report::figuresHtml(page.charts, {report::PlotGroup::relations})},
                   {"correlations", "Every number against every output", correlationTable(summary)},
                   {"indices", "First-order indices", indexTable(summary)},
                   {"worst", "Worst points", worstTable(summary)},
                   {"outputs", "Outputs", histograms(summary) + outputsTable(summary)},
                   {"numbers", "Varied numbers", parametersTable(summary)},
                   {"paste", "Table to paste", pasteBox(summary)}};
  page.footer = fmt::format("<p>ursula {}. Every point and number: <code>ursula sweep report DB --csv FILE</code>.</p>",
                            report::escaped(identity.version));
  return report::pageHtml(page);
}

}  // namespace ursula
