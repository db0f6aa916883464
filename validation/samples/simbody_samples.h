#pragma once

#include <array>
#include <vector>

#include "model/joint_variables.h"
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

/// The joint reactions at one instant, under the torques of the solver that computed them.
struct ReactionSample {
  Reactions recovered;      ///< from the solver's formulation
  PerLeg<double> errors{};  ///< of each leg, relative to Simbody's mobilizer and constraint reactions, N
};

/// The reactions that `subject` computes under its own torques at the motions of `samples`, which may be Conditions or
/// PointwiseSample. Throws PoseError like the subject.
template <class Sample>
std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<Sample>& samples);

}  // namespace ursula
