#pragma once

#include <string>
#include <vector>

#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// Leaves out what the user names: "fluid", "ball-friction", "passive-armature", "passive-friction", "springs",
/// "limits"; passive joints are those without a motor. Says each with its size. Throws InvalidParameter at `place` for
/// another word.
void leaveOut(ModelGraph& graph, const std::vector<std::string>& words, const std::string& place);

}  // namespace ursula::exchange
