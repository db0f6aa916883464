#pragma once

#include <string>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

// Parts of the page in HTML; empty if there is nothing to draw.

std::string histograms(const SweepSummary& summary);
std::string scatterPlots(const SweepSummary& summary);
std::string gridMaps(const SweepSummary& summary);

}  // namespace ursula
