#pragma once

#include <vector>

#include "validation/limits/growth.h"
#include "validation/replay/beside_path.h"
#include "validation/samples/direct_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/presentation.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `direct.pointwise`: the subject's direct dynamics (36) against Simbody's, `direct` at some of `samples`. Only for
/// subjects that have it.
Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units = {});

/// `direct.growth`: how a deviation grows by the variational equations of the subject's direct dynamics, `growth` until
/// path.end(), against what it does in Simbody's loop, really put off the path by as much either way. `second_look`:
/// what fails is held against replays with more steps, too.
Check judgeGrowth(const Growth& growth, const BesidePath& path, const Units& units = {}, bool second_look = true);

}  // namespace ursula
