#pragma once

#include <string>
#include <vector>

#include "studies/map/pose_grid.h"
#include "studies/stream/blocks.h"

namespace ursula {

/// What is drawn of each pose, in the grid's order; NaN where there is none.
struct DrawnMap {
  std::vector<float> kappa, sine, effort;  ///< NaN kappa: out of reach
  std::string effort_unit;                 ///< "N·m", or "N"
};

/// A row for each pose of `grid`: position of P, m; roll, pitch, yaw, rad; `reach`, 1 where all legs can take the pose,
/// else 0; `kappa_B`, the condition number of B of (23) with moments over the machine's length; `sine_i`, each leg's
/// margin (LegMargins::sine), and `sine_min`; `tau_max`, the largest effort that holds the pose at rest, under gravity
/// and the scenario's load, by BatchDynamics. NaN where reach is 0, or the pose is singular. Fills `drawn` unless null.
BlockTable mapBlocks(const Scenario& scenario, const PoseGrid& grid, DrawnMap* drawn);

/// The most poses that mapPicture draws.
constexpr std::size_t most_drawn = 1'000'000;

/// κ, sine and effort as heat maps over the first two axes, SVG: a row of them for each of at most six values of the
/// third. What is out of reach is grey.
std::string mapPicture(const Scenario& scenario, const PoseGrid& grid, const DrawnMap& drawn);

}  // namespace ursula
