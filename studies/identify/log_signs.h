#pragma once

#include <vector>

#include "studies/identify/comparison.h"
#include "studies/identify/identify.h"

namespace ursula::identification {

/// Saturation, whose rows are then missing, and quantisation coarser than the noise.
void findSigns(MeasuredLog& log, const Motors& motors, std::vector<LogFinding>& findings);

/// Efforts of other motors, of the other sign, or in other units than those of the model.
void findMistakes(const ModelledLog& modelled, const Motors& motors, std::vector<LogFinding>& findings,
                  std::vector<MeasuredCause>& causes);

/// What white noise on the log's samples leaves of each motor's effort after the low passes, N·m or N; zero where the
/// motion is by poses.
struct ExpectedNoise {
  Vector6d whole = Vector6d::Zero(), of_motion = Vector6d::Zero();
};
ExpectedNoise expectedNoise(const ModelledLog& modelled, const MeasuredLog& log, const Periods& periods);

}  // namespace ursula::identification
