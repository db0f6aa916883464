#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/plots.h"
#include "studies/compare/compare.h"

namespace ursula {

/// The two charts of one channel.
struct ChannelCharts {
  report::Plot curves;      ///< both histories and the tolerance's tube
  report::Plot difference;  ///< test less reference, and the tube about zero
};

/// Thinned for the eye: the more channels, the more.
ChannelCharts channelCharts(const ChannelComparison& channel, const ChannelCurves& curves, std::size_t channel_count);

/// What was compared with what, for people.
struct ComparedFiles {
  std::string reference, test;
};

/// The verdict in a sentence: what differs most, or how near the nearest came.
std::string comparisonSentence(const Comparison& comparison);

/// One page that needs no network: verdict, table and every channel's charts, the worst first. `charts` are those of
/// the comparison's channels, in their order.
std::string comparisonHtml(const Comparison& comparison, const std::vector<ChannelCharts>& charts,
                           const ComparedFiles& files);

/// Compares, and writes `junit.xml`, `compare.csv` and `compare.html` into `dir`, all or none. Throws what
/// OutputFolder throws.
Comparison writeComparison(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                           const ComparedFiles& files, const std::filesystem::path& dir);

}  // namespace ursula
