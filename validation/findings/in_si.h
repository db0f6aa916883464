#pragma once

#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Converts series and curves from a change of frame's units and origin to SI and B, by the names of their columns.
void seriesInSi(const FrameChange& from, ValidationResult& result);

}  // namespace ursula
