#pragma once

#include <optional>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// Where a key stands in a scenario's file.
struct KeyPlace {
  std::string place;             ///< `file:line:column` of its value, or of the nearest table around it
  std::string key;               ///< dotted; of manipulator.leg_defaults where a leg inherits it
  bool given = false;            ///< in the leg itself or in the defaults
  std::optional<double> number;  ///< its value as written, where that is a number
};

/// Finds a dotted key (`manipulator.leg[2].proximal.mass`, legs 1-based). The scenario must have been read from text;
/// for one that a program made, the place is its file's first line.
KeyPlace placeInFile(const Scenario& scenario, const std::string& key);

}  // namespace ursula
