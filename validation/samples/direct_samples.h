#pragma once

#include <array>
#include <vector>

#include "validation/samples/pointwise.h"

namespace ursula {

/// What Simbody's loop does in one state under given torques.
struct DirectAnswer {
  Motion<double> state;          ///< its accelerations are not read
  Vector6d torques, twist_rate;  ///< N·m, [ω̇; p̈]
};

/// Accelerations of the platform in Simbody at one instant.
struct DirectSample {
  std::size_t sample = 0;  ///< of which of the samples
  /// In the commanded state, under the commanded torques and with each motor's changed in turn, so that every column of
  /// the mass matrix shows.
  std::array<DirectAnswer, 1 + motor_count> commanded;
  /// Under the commanded torques in states off the path; fewer where a leg does not reach.
  std::vector<DirectAnswer> off_path;
};

/// At some of `conditions`, where `simbody` are its answers.
std::vector<DirectSample> runDirect(const Scenario& scenario, const std::vector<Conditions>& conditions,
                                    const std::vector<SimbodyAnswer>& simbody);

}  // namespace ursula
