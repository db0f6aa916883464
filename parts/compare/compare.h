#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/csv.h"
#include "report/files/report.h"
#include "validation/verdict/result.h"

namespace ursula {

struct CompareOptions {
  /// Tolerance of values, relative to the scale of the channel's group. The default exceeds the difference of two right
  /// computations (rounding: 25 eps times condition numbers, some 1e-12). It is below the smallest relative parameter
  /// error that must be found (1e-8).
  double tolerance = 1e-9;
  double time_tolerance = 0;  ///< s
  /// Whether to interpolate the reference between its instants or to skip the test's instants there. By default it
  /// interpolates if the reference has at least as many instants as the test.
  std::optional<bool> interpolate = std::nullopt;
  std::vector<std::string> columns = {};  ///< patterns of the compared columns, with at most one `*` each; empty: all
};

/// The comparison of one channel of two histories.
struct ChannelComparison {
  std::string name;
  std::string group;     ///< `scale` is the largest magnitude of this group: "tau_*_Nm"
  double scale = 0;      ///< in the channel's unit
  double tolerance = 0;  ///< in the channel's unit
  double max_error = 0;  ///< NaN if a value of either is NaN, as are the numbers below
  double max_at = 0;     ///< s
  double rms_error = 0, final_error = 0;
  double outside = 0;        ///< the largest distance from the tube around the reference, in the channel's unit
  double interpolation = 0;  ///< estimated error of the reference's interpolation, in the channel's unit
  Verdict verdict = Verdict::fail;
};

struct Comparison {
  std::vector<ChannelComparison> channels;  ///< common to both, in the reference's order
  std::vector<std::string> only_in_reference, only_in_test;
  std::size_t instants = 0;      ///< number of compared instants of the test
  std::size_t interpolated = 0;  ///< number of them between two instants of the reference
  std::size_t left_out = 0;      ///< instants of the test that are skipped between two of the reference
  std::size_t skipped = 0;       ///< instants of the reference in gaps of the test that span three or more of them
  double from = std::numeric_limits<double>::quiet_NaN(), to = from;        ///< overlap, s
  double reference_from = 0, reference_to = 0, test_from = 0, test_to = 0;  ///< s
  bool covers_reference = false;  ///< whether the test reaches both ends of the reference
  Verdict verdict = Verdict::fail;

  std::size_t referenceChannels() const { return channels.size() + only_in_reference.size(); }
};

/// One channel at the compared instants, for plots; empty if nothing was compared.
struct ChannelCurves {
  std::vector<double> t, reference, test;
  /// The tube for the test: the reference's range within ± the time tolerance, widened by the tolerance.
  std::vector<double> low, high;
};

/// Receives each channel of a comparison once, in their order.
using CurveSink = std::function<void(const ChannelComparison&, const ChannelCurves&)>;

/// Reads a CSV, or `timeseries.csv` of a results folder, or `inverse.csv` if that is missing. It has increasing `t_s`
/// and channels that may contain NaN. Throws CsvError, and report::MixedResults for a folder with files of several
/// runs.
TimeSeries readHistory(const std::filesystem::path& file_or_folder);
/// The same for a parsed table.
TimeSeries historyOf(const CsvTable& table);

/// Compares each channel at the test's instants within the reference's. A value is accepted if the reference is within
/// `tolerance` of it anywhere within ± `time_tolerance`; NaN never is. Quaternions are compared as rotations: q and −q
/// are equal.
///
/// Errors are those at the same instant. A channel is inconclusive if it leaves the tube by no more than the
/// interpolation error. The comparison fails if a channel fails or none is common. It is inconclusive if the test lacks
/// a channel or a part of the reference's time, at its ends or by gaps.
Comparison compare(const TimeSeries& reference, const TimeSeries& test, const CompareOptions& options,
                   const CurveSink& curves = nullptr);

/// Returns the table for people, ending in "compared n of m channels" and what was not compared.
std::string comparisonText(const Comparison& comparison);

/// Returns the uncompared parts, and reasons for a verdict below pass, one per line.
std::string comparisonRemarks(const Comparison& comparison);

/// Returns one row per channel.
std::string comparisonCsv(const Comparison& comparison);

/// Returns each channel as a check of the suite `name`, for JUnit. Channels only in the reference are inconclusive.
SuiteEntry comparisonSuite(const Comparison& comparison, const std::string& name);

}  // namespace ursula
