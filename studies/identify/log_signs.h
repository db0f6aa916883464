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

/// Noise of each motor's effort after the low passes, N·m or N, as white noise on the log's samples explains it. Both
/// are zero for poses.
struct ExpectedNoise {
  Vector6d whole = Vector6d::Zero(), of_motion = Vector6d::Zero();
};
ExpectedNoise expectedNoise(const ModelledLog& modelled, const MeasuredLog& log, const Periods& periods);

}  // namespace ursula::identification
