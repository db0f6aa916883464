#pragma once

#include <string_view>
#include <vector>

#include "model/scenario_keys.h"

namespace ursula {

/// The tables of a scenario with `[mechanism]`, the document first; as scenarioTables().
const std::vector<ScenarioTable>& mechanismTables();

/// Throws std::out_of_range for an unknown table.
const ScenarioTable& mechanismTable(std::string_view name);

}  // namespace ursula
