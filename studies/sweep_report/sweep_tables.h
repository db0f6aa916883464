#pragma once

#include <string>

#include "studies/sweep_report/sweep_summary.h"

namespace ursula {

// Parts of the page in HTML; empty if there is nothing to show.

/// The numbers that drive the primary output, with bars.
std::string driversTable(const SweepSummary& summary);
/// Parameters by outputs: rank correlations, and first-order indices.
std::string correlationTable(const SweepSummary& summary);
std::string indexTable(const SweepSummary& summary);
std::string outputsTable(const SweepSummary& summary);
std::string worstTable(const SweepSummary& summary);
std::string parametersTable(const SweepSummary& summary);
std::string pasteBox(const SweepSummary& summary);

}  // namespace ursula
