#pragma once

#include <string>
#include <vector>

#include "report/plots.h"

namespace ursula::report {

/// Returns a chart with its caption and its static drawing, or with a place for the script's drawing. `index` is that
/// of the chart in the page's data.
enum class Drawing { with, without };
std::string figureHtml(const Plot& plot, std::size_t index, const char* heading, Drawing drawing = Drawing::with);

/// Returns the figures of one group side by side; "" if there is none.
std::string figuresHtml(const std::vector<Plot>& plots, PlotGroup group);

}  // namespace ursula::report
