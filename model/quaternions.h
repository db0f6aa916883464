#pragma once

#include <vector>

#include "model/motion.h"

namespace ursula {

/// Orientations of M in B as unit quaternions [w, x, y, z], w ≥ 0 in the first and each on the same side as the one
/// before: what the files of this program show of a motion.
std::vector<Eigen::Vector4d> quaternions(const std::vector<Motion<double>>& motions);

}  // namespace ursula
