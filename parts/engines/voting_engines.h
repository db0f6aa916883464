#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/engine.h"

namespace ursula {

// Each engine's folder defines its own function.
MakeEngine makeMaximalLoop, makeMujocoLoop;
bool mujocoAvailable();  ///< false if this build lacks MuJoCo

/// Adds the rows of this part to furtherEngines(). A new voting engine needs a folder beside this file and a row.
void addEngines(std::vector<EngineKind>& rows);
/// Adds versions of the engines' libraries to partProvenance().
void addEnginesProvenance(std::vector<std::pair<std::string, std::string>>& rows);

}  // namespace ursula
