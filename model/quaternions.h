#pragma once

#include <vector>

#include "model/motion.h"

namespace ursula {

/// Returns orientations of M in B as unit quaternions [w, x, y, z], as the output files give them. The first has w ≥ 0;
/// each other has the sign nearer to its predecessor.
std::vector<Eigen::Vector4d> quaternions(const std::vector<Motion<double>>& motions);

}  // namespace ursula
