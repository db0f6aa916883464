#pragma once

#include <filesystem>

#include "exchange/recognise/chains.h"
#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// What `ursula import` gives.
struct Imported {
  std::string scenario;  ///< TOML
  std::vector<Assumption> assumptions;
};

/// Reads a model in SDF, MJCF or URDF and makes a scenario of it. Reads this file alone (of URDF a robot.yaml beside it
/// as well), and nothing from a network. Throws ImportError, its text `file:line: error: …`.
Imported importModel(const std::filesystem::path& file, const ImportChoices& choices);

/// The graph alone, likewise.
ModelGraph readModel(const std::filesystem::path& file);

}  // namespace ursula::exchange
