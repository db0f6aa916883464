#pragma once

#include <array>
#include <vector>

#include "validation/samples/pointwise.h"

namespace ursula {

/// The response of Simbody's loop in one state under given torques.
struct DirectAnswer {
  Motion<double> state;          ///< its accelerations are ignored
  Vector6d torques, twist_rate;  ///< N·m, [ω̇; p̈]
};

/// Accelerations of the platform in Simbody at one instant.
struct DirectSample {
  std::size_t sample = 0;  ///< index of the sample
  /// In the commanded state, under the commanded torques and with each motor's torque changed in turn. So every column
  /// of the mass matrix has an effect.
  std::array<DirectAnswer, 1 + motor_count> commanded;
  /// Under the commanded torques in states off the path; fewer if a leg cannot reach.
  std::vector<DirectAnswer> off_path;
};

/// Asks Simbody at some of `conditions`; `simbody` are its earlier answers there.
std::vector<DirectSample> runDirect(const Scenario& scenario, const std::vector<Conditions>& conditions,
                                    const std::vector<SimbodyAnswer>& simbody);

}  // namespace ursula
