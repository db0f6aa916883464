#pragma once

#include <cstddef>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Returns the k-th of `count` equally spaced instants, k from 0.
inline double instantOf(double duration, int k, int count) { return duration * k / (count - 1); }

/// Returns `count` equally spaced instants from 0 to `duration`, both included.
std::vector<double> equallySpaced(double duration, int count);

/// Returns the instants at which a higher derivative of motion or load jumps, in order.
std::vector<double> allKnots(const Scenario& scenario);

/// A replay steps to each of up to this many knots. If there are more, it skips each that is less than a 4096th of the
/// motion after another; the integration loses its order there.
constexpr std::size_t most_knots = 2048;

/// Returns the knots within (start, end) that a replay steps to.
std::vector<double> knotsWithin(const Scenario& scenario, double start, double end);

}  // namespace ursula
