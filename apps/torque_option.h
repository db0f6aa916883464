#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "validation/subject/torque_file.h"

namespace ursula {

/// `--map NAME=COLUMN`, any number of them.
void addMapOption(CLI::App& verb, std::vector<std::string>& map);

/// Reads a torque file and says on stderr, once, how it was read and which columns were passed over. Throws CsvError as
/// readTorqueFile and parseColumnMap do.
TorqueFile readTorquesAloud(const std::string& file, const std::vector<std::string>& map, const Motors& motors);

}  // namespace ursula
