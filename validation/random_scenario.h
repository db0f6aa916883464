#pragma once

#include <cstdint>

#include "model/scenario.h"

namespace ursula {

/// A valid scenario made from a seed: geometry about the paper's, axes tilted any way within 35°, knees of both kinds,
/// masses over two orders of magnitude, full inertia tensors, friction, loads, gravity tilted; a helix, waypoints or a
/// pose to hold that every leg can follow. The same seed gives the same scenario on every machine. Motions that come
/// near a singularity (κ(B) κ(legs) above 10⁴) are drawn again, so that what is drawn can be judged.
Scenario randomScenario(std::uint64_t seed);

}  // namespace ursula
