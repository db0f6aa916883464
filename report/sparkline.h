#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// The replay's error in position, m: the largest in each of few equal parts of the rows, NaN where there is none.
/// Empty where there was no replay.
std::vector<double> trendOf(const TimeSeries& series);

/// A trend as a line over decades, the size of a word; "" where nothing is to be drawn.
std::string sparkline(const std::vector<double>& trend);

}  // namespace ursula::report
