#pragma once

#include <string>
#include <vector>

#include "report/plots.h"

namespace ursula::report {

/// A chart with its caption and its static drawing, or a place for what the script draws: chart `index` of the page's
/// data.
enum class Drawing { with, without };
std::string figureHtml(const Plot& plot, std::size_t index, const char* heading, Drawing drawing = Drawing::with);

/// Those of one group, side by side; "" where there is none.
std::string figuresHtml(const std::vector<Plot>& plots, PlotGroup group);

}  // namespace ursula::report
