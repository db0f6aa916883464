#pragma once

#include <functional>
#include <vector>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// The pairs to draw: the two that drive the primary output most, then the strongest of other outputs, each output
/// once and no parameter more than twice. What is not distinguishable from unrelated is not drawn. No rows yet.
std::vector<Scatter> pairsToDraw(const SweepSummary& summary, std::size_t most);

/// Which of `rows` are drawn: all, or most_scattered spread evenly and without a period.
std::vector<std::size_t> rowsToDraw(std::size_t rows);

/// The outputs that are drawn over a grid of two parameters.
std::vector<std::size_t> outputsToMap(const SweepSummary& summary, std::size_t most);

/// `values` of the points at `x`, `y` on the grid of these ascending levels.
std::vector<double> onGrid(const std::vector<double>& x_levels, const std::vector<double>& y_levels,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& values);

}  // namespace ursula
