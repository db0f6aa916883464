#pragma once

#include <string>

#include "report/plots.h"

namespace ursula::report {

/// Returns a chart as a static drawing, for readers without scripts, for paper and for download. The page's style
/// defines its colour classes. Empty if nothing can be drawn.
std::string svgPlot(const Plot& plot);

/// Round numbers within [low, high], about `count` of them.
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace ursula::report
