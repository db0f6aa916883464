#pragma once

#include <string>

#include "report/plots.h"

namespace ursula::report {

/// A chart as a static drawing: for readers without scripts, for paper, and to be saved. Colours are classes of the
/// page's style. Empty where nothing can be drawn.
std::string svgPlot(const Plot& plot);

/// Round numbers within [low, high], about `count` of them.
std::vector<double> roundTicks(double low, double high, int count);

}  // namespace ursula::report
