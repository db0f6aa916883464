#pragma once

#include <array>
#include <vector>

#include "validation/samples/pointwise.h"

namespace ursula {

/// Accelerations of the platform in Simbody at one instant, under the commanded torques and with each motor's changed
/// in turn, so that every column of the mass matrix shows.
struct DirectSample {
  std::size_t sample = 0;                                        ///< of which of the samples
  std::array<Vector6d, 1 + motor_count> torques, accelerations;  ///< N·m, [ω̇; p̈]
};

/// At some of `samples`, of which motion and Simbody's torques count.
std::vector<DirectSample> runDirect(const Scenario& scenario, const std::vector<PointwiseSample>& samples);

}  // namespace ursula
