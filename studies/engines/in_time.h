#pragma once

#include "studies/engines/reference.h"
#include "studies/engines/side_by_side.h"

namespace ursula {

/// `largest_effort` is that of the motion, to which the servo's is related.
InTimeFound moveInTime(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference, double window,
                       double largest_effort);

/// Sorts.
double median(std::vector<double> values);

}  // namespace ursula
