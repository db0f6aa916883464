#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "validation/subject/torque_file.h"

namespace ursula {

/// Adds the repeatable option `--map NAME=COLUMN`.
void addMapOption(CLI::App& verb, std::vector<std::string>& map);

/// Reads a torque file and reports once on stderr how it was interpreted and which columns were ignored. Throws
/// CsvError like readTorqueFile and parseColumnMap.
TorqueFile readTorquesAloud(const std::string& file, const std::vector<std::string>& map, const Motors& motors);

}  // namespace ursula
