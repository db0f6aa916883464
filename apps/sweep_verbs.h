#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "validation/sweep/run.h"

namespace ursula {

/// The verbs within `ursula sweep`.
void addSweepMerge(CLI::App& sweep, std::function<int()>& run);
void addSweepReport(CLI::App& sweep, std::function<int()>& run);
void addSweepShow(CLI::App& sweep, std::function<int()>& run);

/// "tolerances.db", "tolerances.shard-2-of-4.db".
std::string defaultDatabase(const std::string& stem, const Shard& shard);

}  // namespace ursula
