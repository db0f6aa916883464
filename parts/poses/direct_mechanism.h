#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/mechanism_scenario.h"

namespace ursula {

/// Writes the assembly of each row of `motion`, which has the motors' coordinates: t_s if the file has it, the motors'
/// and all other joints' coordinates, and the output body's pose. A row continues the assembly of the row before, the
/// first one that at the start of the scenario's motion. Throws CsvError with the row's place if the loops cannot
/// follow. `map` is that of the user.
/// Returns the exit code.
int directOfMechanism(const MechanismScenario& scenario, const std::filesystem::path& motion, const std::string& out,
                      const std::vector<std::string>& map = {});

}  // namespace ursula
