#pragma once

#include "studies/engines/side_by_side.h"

namespace ursula {

TimeSteppingResult moveInTime(const LoopEngine& engine, const Rigidity& rigidity, EngineReference& reference,
                              double moved);

/// Reorders its copy of the values. Returns 0 for none.
double median(std::vector<double> values);

}  // namespace ursula
