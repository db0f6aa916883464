#pragma once

#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Series and curves from a change of frame's units and origin to SI and B, by their columns' names.
void seriesInSi(const FrameChange& from, ValidationResult& result);

}  // namespace ursula
