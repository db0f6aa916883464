#pragma once

#include <vector>

#include "model/joint_reactions.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/simbody_answers.h"

namespace ursula {

/// The joint reactions at one instant, under the torques of whoever recovered them.
struct ReactionSample {
  Reactions recovered, simbody;  ///< from the solver's formulation; Simbody's mobilizer and constraint reactions
};

/// What `subject` recovers under its own torques, at the motions of `samples`; `simbody` are its answers there.
std::vector<ReactionSample> runReactions(const Scenario& scenario, const Subject& subject,
                                         const std::vector<PointwiseSample>& samples,
                                         const std::vector<SimbodyAnswer>& simbody);

/// The NOC's, at the motions of `samples`. Throws PoseError as the solver does.
std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples);
/// `simbody` are its answers at the instants of `samples`.
std::vector<ReactionSample> runReactions(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                         const std::vector<SimbodyAnswer>& simbody);

}  // namespace ursula
