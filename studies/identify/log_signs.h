#pragma once

#include <vector>

#include "studies/identify/comparison.h"
#include "studies/identify/identify.h"

namespace ursula::identification {

/// Finds saturation, and marks its rows as missing. Also finds quantisation that is coarser than the noise.
void findSigns(MeasuredLog& log, const Motors& motors, std::vector<LogFinding>& findings);

/// Finds efforts of exchanged motors, of the other sign, or in other units than the model's.
void findMistakes(const ModelledLog& modelled, const Motors& motors, std::vector<LogFinding>& findings,
                  std::vector<MeasuredCause>& causes);

}  // namespace ursula::identification
