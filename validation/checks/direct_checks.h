#pragma once

#include <vector>

#include "validation/samples/direct_samples.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/subject.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `direct.pointwise` compares the subject's direct dynamics (36) with Simbody's; `direct` is at some of `samples`.
/// Only for subjects that have direct dynamics.
Check judgeDirect(const std::vector<DirectSample>& direct, const Subject& subject,
                  const std::vector<PointwiseSample>& samples, const RoundingProfile& profile, const Units& units = {});

/// `direct.off_path`: the same in states off the commanded motion, where the trajectory cannot help.
Check judgeOffPath(const std::vector<DirectSample>& direct, const Subject& subject,
                   const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                   const Units& units = {});

}  // namespace ursula
