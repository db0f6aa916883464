#include <fmt/format.h>

#include <algorithm>

#include "base/csv.h"
#include "parts/compare/compare.h"
#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// "3 channels only in the test: a, b, c\n"; a long list shows the first few and the count.
std::string onlyIn(const char* side, const std::vector<std::string>& names) {
  constexpr std::size_t shown = 6;
  if (names.empty()) return "";
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(shown, names.size()));
  return fmt::format("{} channel{} only in the {}: {}{}\n", names.size(), names.size() == 1 ? "" : "s", side,
                     fmt::join(names.begin(), end, ", "), names.size() > shown ? ", …" : "");
}

double largestInterpolation(const Comparison& comparison, std::string& channel) {
  double most = 0;
  for (const ChannelComparison& each : comparison.channels) {
    const double share = each.scale > 0 ? each.interpolation / each.scale : 0;
    if (!exceeds(share, most)) continue;
    most = share;
    channel = each.name;
  }
  return most;
}

}  // namespace

std::string comparisonRemarks(const Comparison& c) {
  std::string out;
  if (c.instants + c.left_out == 0)
    out += fmt::format("nothing to compare: the reference spans {:.6g} to {:.6g} s, the test {:.6g} to {:.6g} s\n",
                       c.reference_from, c.reference_to, c.test_from, c.test_to);
  else if (c.from != c.reference_from || c.to != c.reference_to || c.from != c.test_from || c.to != c.test_to)
    out += fmt::format(
        "compared from {:.6g} to {:.6g} s only: the reference spans {:.6g} to {:.6g} s, the test {:.6g} to {:.6g} "
        "s{}\n",
        c.from, c.to, c.reference_from, c.reference_to, c.test_from, c.test_to,
        c.covers_reference ? "" : "; the reference is not covered");
  if (c.interpolated > 0) {
    std::string channel = "all";
    const double missed = largestInterpolation(c, channel);
    out += fmt::format(
        "the reference was interpolated at {} of {} instants, which may miss {:.2g} of a channel's scale ({})\n",
        c.interpolated, c.instants, missed, channel);
  }
  if (c.left_out > 0)
    out += fmt::format(
        "not compared are {} instants of the test between two of the reference, which is coarser: --interpolate\n",
        c.left_out);
  if (c.skipped > 0)
    out += fmt::format("not compared are {} instants of the reference in gaps of the test\n", c.skipped);
  out += onlyIn("reference", c.only_in_reference) + onlyIn("test", c.only_in_test);
  if (c.channels.empty()) out += "no channel is common to both\n";
  return out;
}

std::string comparisonText(const Comparison& comparison) {
  std::size_t width = 7;
  for (const ChannelComparison& channel : comparison.channels) width = std::max(width, channel.name.size());
  std::string out = fmt::format("{:<12} {:<{}} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "verdict", "channel",
                                width, "maximum", "at t (s)", "RMS", "final", "tolerance", "scale");
  for (const ChannelComparison& c : comparison.channels)
    out += fmt::format("{:<12} {:<{}} {:>10.3g} {:>10.6g} {:>10.3g} {:>10.3g} {:>10.3g} {:>10.4g}\n", name(c.verdict),
                       c.name, width, c.max_error, c.max_at, c.rms_error, c.final_error, c.tolerance, c.scale);
  std::size_t passed = 0;
  for (const ChannelComparison& c : comparison.channels) passed += c.verdict == Verdict::pass ? 1 : 0;
  out += comparisonRemarks(comparison);
  out += fmt::format("compared {} of {} channels at {} instants; {} within tolerance\nverdict: {}\n",
                     comparison.channels.size(), comparison.referenceChannels(), comparison.instants, passed,
                     name(comparison.verdict));
  return out;
}

std::string comparisonCsv(const Comparison& comparison) {
  std::string out = "channel,verdict,max_error,t_max_s,rms_error,final_error,outside,tolerance,scale,group\n";
  for (const ChannelComparison& c : comparison.channels) {
    appendCsvCell(c.name, out);
    out += fmt::format(",{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},", name(c.verdict), c.max_error,
                       c.max_at, c.rms_error, c.final_error, c.outside, c.tolerance, c.scale);
    appendCsvCell(c.group, out);
    out += '\n';
  }
  return out;
}

SuiteEntry comparisonSuite(const Comparison& comparison, const std::string& suite) {
  SuiteEntry entry;
  entry.scenario = suite;
  entry.verdict = comparison.verdict;
  for (const ChannelComparison& c : comparison.channels) {
    Check check;
    check.name = c.name;
    check.value = c.outside;
    check.limit = c.tolerance;
    check.verdict = c.verdict;
    check.basis = fmt::format("the tolerance times {:.6g}, the largest magnitude of {}", c.scale, c.group);
    check.why = fmt::format("largest deviation {:.3g} at t = {:.6g} s, RMS {:.3g}; interpolation may miss {:.2g}",
                            c.max_error, c.max_at, c.rms_error, c.interpolation);
    entry.checks.push_back(check);
  }
  for (const std::string& missing : comparison.only_in_reference)
    entry.checks.push_back(notJudgeable(Reason::not_covered, missing, 0, 0, "", "", "only the reference has it"));
  return entry;
}

}  // namespace ursula
