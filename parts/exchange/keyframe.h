#pragma once

#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// Takes the pose of the keyframe `asked` as the initial one. Without such a name it takes one if the bodies' own pose
/// leaves a loop open by more than 1e-3 of `size` or rad, the keyframe's less, and the keyframe is the only one or
/// named "home". Says so. Throws ImportError for a name that no keyframe has, and for a keyframe with another count of
/// numbers than the model has coordinates.
void takeKeyframe(ModelGraph& graph, double size, const std::string& asked);

}  // namespace ursula::exchange
