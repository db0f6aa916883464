#pragma once

#include <vector>

#include "validation/limits/linearisation.h"

namespace ursula {

/// Φ(end, 0) of somebody's variational equations, and how well it is known.
struct Growth {
  Linearisation::Matrix12 Phi;
  /// The same with intervals twice as long, and with central differences of twice the step: what either changes is more
  /// than what Phi is off by.
  Linearisation::Matrix12 coarser, blunter;
  std::vector<double> halved_at;  ///< increasing: where the equations change fast, s
};

/// Over intervals of duration / `intervals` at most, that end at the knots of motion and load, halved where the
/// equations change faster than that resolves: where a joint with Coulomb friction passes through its smoothing speed,
/// and where halving still tells.
Growth growthOf(const Scenario& scenario, const AccelerationUnder& accelerations, double end, int intervals);

}  // namespace ursula
