#pragma once

#include <string>
#include <vector>

#include "studies/map/pose_grid.h"
#include "studies/stream/blocks.h"

namespace ursula {

/// The plotted values of each pose, in the grid's order; NaN if missing.
struct DrawnMap {
  std::vector<float> kappa, sine, effort;  ///< NaN kappa means out of reach
  std::string effort_unit;                 ///< "N·m", or "N"
};

/// One row per pose of `grid`: position of P, m; roll, pitch, yaw, rad; `reach`, 1 if all legs can take the pose, else
/// 0. `kappa_B` is the condition number of B of (23) with moments over the machine's length; `sine_i` is each leg's
/// margin (LegMargins::sine), `sine_min` the smallest. `tau_max` is the largest effort that holds the pose at rest,
/// under gravity and the scenario's load, by BatchDynamics. It is NaN if reach is 0 or the pose is singular. Fills
/// `drawn` unless null.
BlockTable mapBlocks(const Scenario& scenario, const PoseGrid& grid, DrawnMap* drawn);

/// The largest number of poses for mapPicture.
constexpr std::size_t most_drawn = 1'000'000;

/// Returns SVG heat maps of κ, sine and effort over the first two axes. Each of at most six values of the third axis
/// has a row. Poses out of reach are grey.
std::string mapPicture(const Scenario& scenario, const PoseGrid& grid, const DrawnMap& drawn);

}  // namespace ursula
