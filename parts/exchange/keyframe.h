#pragma once

#include "parts/exchange/model_graph.h"

namespace ursula::exchange {

/// Takes the pose of a keyframe as the initial one if the bodies' own leaves a loop open by more than 1e-3 of `size` or
/// rad, the keyframe's less, and the keyframe is the only one or named "home". Says so. Throws ImportError for a
/// keyframe with another count of numbers than the model has coordinates.
void takeKeyframe(ModelGraph& graph, double size);

}  // namespace ursula::exchange
