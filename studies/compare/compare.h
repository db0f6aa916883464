#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/csv.h"
#include "report/report.h"
#include "validation/verdict/result.h"

namespace ursula {

struct CompareOptions {
  /// Of values, relative to the scale of the channel's group. The default lies between what two right computations
  /// differ by (rounding: 25 eps times condition numbers, some 1e-12) and the smallest relative error of a parameter
  /// that must be seen (1e-8).
  double tolerance = 1e-9;
  double time_tolerance = 0;  ///< s
  /// Between its instants the reference is interpolated, or what the test has there is left out. Where nothing is said:
  /// interpolated where it has at least as many instants as the test.
  std::optional<bool> interpolate = std::nullopt;
  std::vector<std::string> columns = {};  ///< patterns of what is compared, with one `*` each at most; empty: all
};

/// Two histories of one channel.
struct ChannelComparison {
  std::string name;
  std::string group;     ///< of which `scale` is the largest magnitude: "tau_*_Nm"
  double scale = 0;      ///< in the channel's unit
  double tolerance = 0;  ///< in the channel's unit
  double max_error = 0;  ///< NaN where a value of either is none; so are the others
  double max_at = 0;     ///< s
  double rms_error = 0, final_error = 0;
  double outside = 0;        ///< the largest distance from the tube about the reference, in the channel's unit
  double interpolation = 0;  ///< what interpolation of the reference may miss, in the channel's unit
  Verdict verdict = Verdict::fail;
};

struct Comparison {
  std::vector<ChannelComparison> channels;  ///< common to both, in the reference's order
  std::vector<std::string> only_in_reference, only_in_test;
  std::size_t instants = 0;      ///< of the test that were compared
  std::size_t interpolated = 0;  ///< of them, between two of the reference
  std::size_t left_out = 0;      ///< instants of the test between two of the reference, where it is not interpolated
  std::size_t skipped = 0;       ///< instants of the reference in gaps of the test, each over three or more of them
  double from = std::numeric_limits<double>::quiet_NaN(), to = from;        ///< overlap, s
  double reference_from = 0, reference_to = 0, test_from = 0, test_to = 0;  ///< s
  bool covers_reference = false;  ///< the test reaches both ends of the reference
  Verdict verdict = Verdict::fail;

  std::size_t referenceChannels() const { return channels.size() + only_in_reference.size(); }
};

/// One channel at the instants compared, to be drawn; no instant where nothing was.
struct ChannelCurves {
  std::vector<double> t, reference, test;
  /// The tube that the test may not leave: the reference's range over ± the time tolerance, widened by the tolerance.
  std::vector<double> low, high;
};

/// Is given each channel of a comparison once, in their order.
using CurveSink = std::function<void(const ChannelComparison&, const ChannelCurves&)>;

/// Reads a CSV, or `timeseries.csv` of a result folder, or `inverse.csv` where it has only that: `t_s`, increasing, and
/// channels that may hold NaN. Throws CsvError, and report::MixedResults for a folder whose files are not of one run.
TimeSeries readHistory(const std::filesystem::path& file_or_folder);
/// The same of a table that was read.
TimeSeries historyOf(const CsvTable& table);

/// Channel by channel, at the test's own instants within the reference's. A value is accepted where the reference comes
/// within `tolerance` of it anywhere within ± `time_tolerance`; NaN never is. Quaternions are compared as rotations: q
/// and −q are the same.
///
/// Errors are those at the same instant. A channel is inconclusive where it leaves the tube by no more than
/// interpolation may miss. The whole fails where a channel does or where nothing
/// is common, and is inconclusive where a channel or a part of the reference's time is missing from the test, at its
/// ends or by gaps.
Comparison compare(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                   const CurveSink& curves = nullptr);

/// The table for people, ending in "compared n of m channels" and what was not.
std::string comparisonText(const Comparison& comparison);

/// What was not compared, and why the verdict may be less than a pass, a line each.
std::string comparisonRemarks(const Comparison& comparison);

/// One row for each channel.
std::string comparisonCsv(const Comparison& comparison);

/// Each channel as a check of the suite `name`, for JUnit; what only the reference has is one that could not be judged.
SuiteEntry comparisonSuite(const Comparison& comparison, const std::string& name);

}  // namespace ursula
