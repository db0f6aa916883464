#pragma once

#include <vector>

#include "validation/limits/rounding_profile.h"
#include "validation/samples/reaction_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `reactions.pointwise` compares the joint reactions from the solver's formulation with Simbody's mobilizer and
/// constraint reactions, at the instants of `samples`. Only for the correct formulas.
Check judgeReactions(const std::vector<ReactionSample>& reactions, const std::vector<PointwiseSample>& samples,
                     const RoundingProfile& profile, const Units& units = {});

}  // namespace ursula
