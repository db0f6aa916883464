#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// The user's choices for what a file does not say and the import does not guess.
struct ImportChoices {
  std::string base, platform;          ///< a body's name, or empty
  std::string key;                     ///< a keyframe's name, or empty
  std::vector<std::string> actuated;   ///< names of joints
  std::vector<std::string> closed;     ///< "A:B", two links whose frame origins a ball joins
  std::vector<std::string> leave_out;  ///< words of leaveOut()
  double tolerance = 1e-5;             ///< relative to the machine's size, and in rad
  double lump = 1e-3;                  ///< share of a leg's moments of inertia that may be lost
};

/// The result of `ursula import`.
struct Imported {
  std::string scenario;  ///< TOML
  Assumptions assumptions;
};

/// Reads a model in SDF, MJCF or URDF and turns it into a scenario. It reads only this file (for URDF also a robot.yaml
/// next to it) and nothing from a network. Throws ImportError with the text `file:line: error: …`.
Imported importModel(const std::filesystem::path& file, const ImportChoices& choices);

/// Returns the command that makes a scenario of a model: `ursula import` where importModel() makes one, else
/// `ursula init`. Throws ImportError if the file is no model, or none of a mechanism either.
std::string adviceOnModel(const std::filesystem::path& file);

/// Reads only the graph, in the same way.
ModelGraph readModel(const std::filesystem::path& file);

}  // namespace ursula::exchange
