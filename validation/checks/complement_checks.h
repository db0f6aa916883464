#pragma once

#include "validation/samples/complement_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `complement.orthogonality` and `complement.rank`: T is the orthogonal complement of D, (33).
std::vector<Check> judgeComplement(const std::vector<ComplementSample>& samples, const Units& units);

}  // namespace ursula
