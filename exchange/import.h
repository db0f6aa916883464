#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exchange/model_graph.h"

namespace ursula::exchange {

/// What cannot be found in a file, or is not to be guessed.
struct ImportChoices {
  std::string base, platform;         ///< a body's name, or empty
  std::vector<std::string> actuated;  ///< joints' names
  std::vector<std::string> closed;    ///< "A:B", links whose frames' origins a ball joins
  double tolerance = 1e-5;            ///< of the machine's size, and rad
  double lump = 1e-3;                 ///< share of a leg's moments that may be lost
};

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
