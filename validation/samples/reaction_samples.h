#pragma once

#include <functional>
#include <vector>

#include "model/joint_reactions.h"
#include "validation/samples/pointwise.h"

namespace ursula {

/// The joint reactions at one instant, under the torques of the formulas that hold.
struct ReactionSample {
  Reactions recovered, simbody;  ///< from the solver's road; Simbody's mobilizer and constraint reactions
};

/// At the instants of `samples`. `spoil`, for controls that must fail, changes those recovered.
std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                         const std::function<void(Reactions&)>& spoil = nullptr);

}  // namespace ursula
