#include "parts/compare/compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/output_folder.h"
#include "report/files/written_files.h"
#include "report/page/html_template.h"
#include "report/page/page.h"
#include "report/page/plots.h"
#include "report/page/sections.h"
#include "report/text/quantity.h"

namespace ursula {

extern const std::string_view compare_channels_html, compare_table_html, compare_missing_html;

namespace {

using report::HtmlValue;
using report::Line;
using report::Plot;
using report::quantity;
using report::rendered;
using report::Stroke;

// These limits keep a page of a hundred channels below 3 MB. They bound the points in all.
constexpr std::size_t buckets_in_all = 9000, fewest_buckets = 60, most_buckets = 400;

/// The used share of a channel's tolerance; infinite for any deviation if the tolerance is 0.
double shareOf(const ChannelComparison& channel) {
  if (channel.outside == 0) return 0;
  return channel.tolerance > 0 ? channel.outside / channel.tolerance : std::numeric_limits<double>::infinity();
}

int rank(Verdict verdict) { return verdict == Verdict::fail ? 0 : verdict == Verdict::inconclusive ? 1 : 2; }

/// Derived channels come after the others of their verdict; NaN counts as the worst share.
std::vector<std::size_t> worstFirst(const std::vector<ChannelComparison>& channels) {
  const auto place = [&channels](std::size_t k) {
    const double share = shareOf(channels[k]);
    return std::tuple(rank(channels[k].verdict), isDerived(channels[k].name), !std::isnan(share),
                      std::isnan(share) ? 0 : -share);
  };
  std::vector<std::size_t> order(channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&place](std::size_t a, std::size_t b) { return place(a) < place(b); });
  return order;
}

std::string sizeText(double share) { return share < 1e-6 ? report::plainNumber(share, 2) : report::percentText(share); }

std::string shareText(const ChannelComparison& channel) {
  const double share = shareOf(channel);
  if (std::isnan(share)) return "is not a number somewhere";
  if (std::isinf(share)) return "differs, with a tolerance of 0";
  if (share > 1)
    return fmt::format("is off by {} at t = {:.6g} s, {} of the largest; its tolerance is {}",
                       quantity(channel.max_error, unitOf(channel.name)), channel.max_at,
                       sizeText(channel.max_error / channel.scale), quantity(channel.tolerance, unitOf(channel.name)));
  return share == 0 ? "is the same" : "is at " + sizeText(share) + " of its tolerance";
}

Plot timePlot(const ChannelCurves& curves, const std::string& title, const std::string& y_label) {
  Plot plot;
  plot.title = title;
  plot.x_label = "t (s)";
  plot.y_label = y_label;
  plot.over_time = plot.tube = true;
  plot.x = curves.t;
  plot.rows = curves.t.size();
  return plot;
}

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::minus<>());
  return out;
}

HtmlValue channelRow(const ChannelComparison& c, std::size_t index) {
  const std::string unit = unitOf(c.name);
  return {{"verdict", name(c.verdict)},
          {"badge", report::verdictBadge(c.verdict)},
          {"index", index},
          {"channel", channelWords(c.name)},
          {"column", c.name},
          {"largest", quantity(c.max_error, unit)},
          {"at", fmt::format("{:.4g}\u00a0s", c.max_at)},
          {"rms", quantity(c.rms_error, unit)},
          {"last", quantity(c.final_error, unit)},
          {"tolerance", quantity(c.tolerance, unit)}};
}

HtmlValue channelGroup(const ChannelComparison& channel, const ChannelCharts& charts, std::size_t index,
                       std::size_t place) {
  return {{"verdict", name(channel.verdict)},
          {"index", index},
          {"open", place == 0 || channel.verdict == Verdict::fail},
          {"badge", report::verdictBadge(channel.verdict)},
          {"channel", channelWords(channel.name)},
          {"column", channel.name},
          {"share", shareText(channel)},
          {"charts", report::figureHtml(charts.curves, 2 * place, "h3") +
                         report::figureHtml(charts.difference, 2 * place + 1, "h3")}};
}

std::string missing(const Comparison& comparison) {
  std::vector<HtmlValue> sides;
  for (const auto& [side, names] :
       {std::pair("reference", comparison.only_in_reference), {"test", comparison.only_in_test}})
    if (!names.empty()) sides.push_back({{"side", side}, {"names", names}});
  return rendered(compare_missing_html, {{"sides", sides}});
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0, to = 0; (to = text.find('\n', from)) != std::string::npos; from = to + 1)
    lines.push_back(text.substr(from, to - from));
  return lines;
}

std::ptrdiff_t countOf(const Comparison& comparison, Verdict verdict) {
  return std::count_if(comparison.channels.begin(), comparison.channels.end(),
                       [verdict](const ChannelComparison& channel) { return channel.verdict == verdict; });
}

}  // namespace

ChannelCharts channelCharts(const ChannelComparison& channel, const ChannelCurves& curves, std::size_t channel_count) {
  const std::size_t buckets =
      std::clamp(buckets_in_all / std::max<std::size_t>(channel_count, 1), fewest_buckets, most_buckets);
  const std::string unit = report::prettyUnit(unitOf(channel.name));
  const std::string label = unit.empty() ? "" : " (" + unit + ")";
  ChannelCharts out;
  const std::string words = channelWords(channel.name);
  out.curves = timePlot(curves, words, words + label);
  out.curves.lines = {{"upper limit", unit, 0, Stroke::limit, curves.high},
                      {"lower limit", unit, 0, Stroke::limit, curves.low},
                      {"reference", unit, 0, Stroke::ghost, curves.reference},
                      {"test", unit, 0, Stroke::line, curves.test}};
  out.difference = timePlot(curves, words + ": test less reference", "difference" + label);
  out.difference.lines = {{"upper limit", unit, 0, Stroke::limit, less(curves.high, curves.reference)},
                          {"lower limit", unit, 0, Stroke::limit, less(curves.low, curves.reference)},
                          {"difference", unit, 0, Stroke::line, less(curves.test, curves.reference)}};
  out.curves = thinned(out.curves, buckets);
  out.difference = thinned(out.difference, buckets);
  return out;
}

std::string comparisonSentence(const Comparison& c) {
  if (c.channels.empty()) return "Nothing is common to both.";
  if (c.instants + c.left_out == 0) return "The two histories have no time in common.";
  const ChannelComparison& worst = c.channels[worstFirst(c.channels).front()];
  const std::string off =
      fmt::format("{} at t = {:.6g} s", quantity(worst.max_error, unitOf(worst.name)), worst.max_at);
  const std::string words = channelWords(worst.name);
  const std::string of = fmt::format("of {} channels at {} instants", c.channels.size(), c.instants);
  if (worst.verdict == Verdict::fail)
    return report::unbroken(fmt::format("The test differs from the reference in {} {}. The {} {}.",
                                        countOf(c, Verdict::fail), of, words, shareText(worst)));
  if (worst.verdict == Verdict::inconclusive)
    return fmt::format("Nothing surely differs, but {} {} cannot be judged.", countOf(c, Verdict::inconclusive), of);
  if (worst.max_error == 0)
    return fmt::format("The test is the same as the reference in {} {}.", countOf(c, Verdict::pass), of);
  return report::unbroken(
      fmt::format("The test agrees with the reference in {} {}: the worst, {}, is off by {} and {}.",
                  countOf(c, Verdict::pass), of, words, off, shareText(worst)));
}

std::string comparisonHtml(const Comparison& comparison, const std::vector<ChannelCharts>& charts,
                           const ComparedFiles& files) {
  report::Page page;
  page.kind = "Comparison";
  page.title = files.test;
  page.subtitle = "against the reference " + files.reference;
  page.verdict = comparison.verdict;
  page.sentence = comparisonSentence(comparison);
  page.remarks = linesOf(comparisonRemarks(comparison));
  page.script = report::charts_script;
  std::vector<HtmlValue> groups, rows;
  const std::vector<std::size_t> order = worstFirst(comparison.channels);
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::size_t k = order[place];
    groups.push_back(channelGroup(comparison.channels[k], charts.at(k), k, place));
    rows.push_back(channelRow(comparison.channels[k], k));
    page.charts.push_back(charts.at(k).curves);
    page.charts.push_back(charts.at(k).difference);
  }
  page.sections = {{"channels", "Channels", rendered(compare_channels_html, {{"channels", groups}})},
                   {"table", "In numbers", rows.empty() ? "" : rendered(compare_table_html, {{"channels", rows}})},
                   {"missing", "Not compared", missing(comparison)}};
  page.footer =
      "<p>The same in numbers: <a href=\"compare.csv\">compare.csv</a>, <a href=\"junit.xml\">junit.xml</a>.</p>";
  return report::pageHtml(page);
}

Comparison writeComparison(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                           const ComparedFiles& files, const std::filesystem::path& dir) {
  std::vector<ChannelCharts> charts;
  const Comparison comparison =
      compare(reference, test, options, [&](const ChannelComparison& channel, const ChannelCurves& curves) {
        charts.push_back(channelCharts(channel, curves, reference.names.size()));
      });
  OutputFolder out(dir);
  out.write("junit.xml", report::junitXml({comparisonSuite(comparison, files.reference + " : " + files.test)}));
  out.write("compare.csv", comparisonCsv(comparison));
  out.write("compare.html", comparisonHtml(comparison, charts, files));
  out.commit();
  return comparison;
}

}  // namespace ursula
