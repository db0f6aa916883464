#pragma once

#include <memory>

#include "model/load.h"
#include "model/trajectory.h"
#include "studies/random/random_machine.h"

namespace ursula {

/// A motion of the recipe's kind about the design's pose. `share` makes it smaller if the legs cannot follow. Throws
/// InvalidParameter if the spline between the poses overshoots too far.
std::shared_ptr<const Trajectory> randomMotion(Dice& dice, const Recipe& recipe, const Design& design, double share);

/// Null if the recipe has no load.
std::shared_ptr<const Load> randomLoad(Dice& dice, const Recipe& recipe, const Design& design);

}  // namespace ursula
