#pragma once

#include <functional>
#include <vector>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// Returns the pairs to draw, without rows. The two strongest of the primary output come first, then the strongest of
/// other outputs. Each of these appears once, a parameter at most twice. Insignificant relations are omitted.
std::vector<Scatter> pairsToDraw(const SweepSummary& summary, std::size_t most);

/// Returns the rows to draw: all, or most_scattered spread evenly and without a period.
std::vector<std::size_t> rowsToDraw(std::size_t rows);

/// Returns the outputs to draw over a grid of two parameters.
std::vector<std::size_t> outputsToMap(const SweepSummary& summary, std::size_t most);

/// Sorts `values` at the points `x`, `y` into the grid of these ascending levels.
std::vector<double> onGrid(const std::vector<double>& x_levels, const std::vector<double>& y_levels,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& values);

}  // namespace ursula
