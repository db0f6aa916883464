#include <fmt/format.h>

#include <algorithm>

#include "validation/compare/compare.h"

namespace ursula {
namespace {

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// What was not compared, and why the verdict may be less than a pass.
std::string remarks(const Comparison& c) {
  std::string out;
  if (c.instants == 0)
    out += fmt::format("nothing to compare: the reference spans {:.6g} to {:.6g} s, the test {:.6g} to {:.6g} s\n",
                       c.reference_from, c.reference_to, c.test_from, c.test_to);
  else if (c.from != c.reference_from || c.to != c.reference_to || c.from != c.test_from || c.to != c.test_to)
    out += fmt::format(
        "compared from {:.6g} to {:.6g} s only: the reference spans {:.6g} to {:.6g} s, the test {:.6g} to "
        "{:.6g} s{}\n",
        c.from, c.to, c.reference_from, c.reference_to, c.test_from, c.test_to,
        c.covers_reference ? "" : "; the reference is not covered");
  if (c.interpolated > 0)
    out += fmt::format("the reference was interpolated linearly at {} of {} instants\n", c.interpolated, c.instants);
  if (c.skipped > 0)
    out += fmt::format("not compared are {} instants of the reference in gaps of the test\n", c.skipped);
  if (!c.only_in_reference.empty()) out += "only in the reference: " + list(c.only_in_reference) + "\n";
  if (!c.only_in_test.empty()) out += "only in the test: " + list(c.only_in_test) + "\n";
  if (c.channels.empty()) out += "no channel is common to both\n";
  return out;
}

}  // namespace

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
  out += remarks(comparison);
  out += fmt::format("compared {} of {} channels at {} instants; {} within tolerance\nverdict: {}\n",
                     comparison.channels.size(), comparison.referenceChannels(), comparison.instants, passed,
                     name(comparison.verdict));
  return out;
}

std::string comparisonCsv(const Comparison& comparison) {
  std::string out = "channel,verdict,max_error,t_max_s,rms_error,final_error,outside,tolerance,scale,group\n";
  for (const ChannelComparison& c : comparison.channels)
    out += fmt::format("{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", c.name, name(c.verdict),
                       c.max_error, c.max_at, c.rms_error, c.final_error, c.outside, c.tolerance, c.scale, c.group);
  return out;
}

}  // namespace ursula
