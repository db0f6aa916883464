#pragma once

#include <array>
#include <vector>

#include "model/joint_reactions.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The joint reactions at one instant, under the torques of the solver that computed them.
struct ReactionSample {
  Reactions recovered;                     ///< from the solver's formulation
  std::array<double, leg_count> errors{};  ///< of each leg, relative to Simbody's mobilizer and constraint reactions, N
};

/// The reactions that `subject` computes under its own torques at the motions of `samples`, which may be Conditions or
/// PointwiseSample.
template <class Sample>
std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<Sample>& samples);

/// The NOC's reactions at the motions of `samples`. Throws PoseError like the solver.
std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples);

}  // namespace ursula
