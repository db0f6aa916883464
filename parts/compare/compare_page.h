#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parts/compare/compare.h"
#include "report/page/plots.h"

namespace ursula {

/// The two charts of one channel.
struct ChannelCharts {
  report::Plot curves;      ///< both histories and the tolerance's tube
  report::Plot difference;  ///< test minus reference, and the tube around zero
};

/// Returns the unit that a column's name ends in: "tau_3_Nm" → "Nm"; "" if there is none.
std::string unitOf(const std::string& channel);

/// Returns a column in words: "tau_3_N" → "force of motor 3", "sim_p_x_m" → "simulated position of P, x".
std::string channelWords(const std::string& channel);

/// Whether a column was computed from others: errors, limits, gaps, the other side's efforts. These come last.
bool isDerived(const std::string& channel);

/// Thins the charts to visible detail; more channels get fewer points each.
ChannelCharts channelCharts(const ChannelComparison& channel, const ChannelCurves& curves, std::size_t channel_count);

/// Names of the compared files, for people.
struct ComparedFiles {
  std::string reference, test;
};

/// Returns the verdict in a sentence: the largest difference, or the nearest to its limit.
std::string comparisonSentence(const Comparison& comparison);

/// Returns one page that needs no network: verdict, table and every channel's charts, the worst first. `charts` are in
/// the order of the comparison's channels.
std::string comparisonHtml(const Comparison& comparison, const std::vector<ChannelCharts>& charts,
                           const ComparedFiles& files);

/// Compares, and writes `junit.xml`, `compare.csv` and `compare.html` into `dir`, all or none. Throws like
/// OutputFolder.
Comparison writeComparison(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                           const ComparedFiles& files, const std::filesystem::path& dir);

}  // namespace ursula
