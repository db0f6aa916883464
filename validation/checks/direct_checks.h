#pragma once

#include <vector>

#include "validation/samples/direct_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `direct.pointwise`: the subject's direct dynamics (36) against Simbody's, `direct` at some of `samples`. Only for
/// subjects that have it.
Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units = {});

/// `direct.off_path`: the same in states that differ from the commanded ones, where nothing of the trajectory helps.
Check judgeOffPath(const std::vector<DirectSample>& direct, const Subject& subject,
                   const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                   const Units& units = {});

}  // namespace ursula
