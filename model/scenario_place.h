#pragma once

#include <optional>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// The place of a key in a scenario's file.
struct KeyPlace {
  std::string place;             ///< `file:line:column` of its value, or of the nearest enclosing table
  std::string key;               ///< dotted; in manipulator.leg_defaults if a leg inherits it
  bool given = false;            ///< whether the leg itself or the defaults give it
  std::optional<double> number;  ///< its value as written, if that is a number
};

/// Finds a dotted key (`manipulator.leg[2].proximal.mass`, legs 1-based) in a scenario that was read. If a program made
/// the scenario, the place is its file's first line.
KeyPlace placeInFile(const Scenario& scenario, const std::string& key);

}  // namespace ursula
