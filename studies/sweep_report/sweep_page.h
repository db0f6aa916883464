#pragma once

#include <string>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

/// report.html: one file that needs neither network nor script.
std::string sweepPage(const SweepSummary& summary);

}  // namespace ursula
