#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// The replay's position error, m: the largest in each of a few equal parts of the rows, NaN for parts without one.
/// Empty without a replay.
std::vector<double> trendOf(const TimeSeries& series);

/// Returns a trend as a line over decades, as large as a word; "" if there is nothing to draw.
std::string sparkline(const std::vector<double>& trend);

}  // namespace ursula::report
