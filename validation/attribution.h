#pragma once

#include <string>
#include <vector>

#include "validation/judge_replay.h"
#include "validation/ladder.h"
#include "validation/pointwise.h"
#include "validation/result.h"

namespace ursula {

/// What may have moved the replay off the path, by cause, at the end of the window where deviations grow most; m.
struct ErrorBudget {
  double model = 0;          ///< the torques' measured pointwise error, carried through the motion
  double integration = 0;    ///< the ladder's extrapolated error
  double closure = 0;        ///< the measured gaps of the loops, carried through the motion
  double observed = 0;       ///< the replay's largest position error
  double amplification = 0;  ///< factor by which a deviation at the start may grow: no error of its own
  std::string dominant;      ///< "model", "integration", "closure" or "amplification"
};

/// Amplification dominates where a replay's limit, not an error, is what prevents a judgement.
ErrorBudget attribute(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                      const Ladder& ladder, const std::vector<Check>& checks);

/// As findings of the report.
void addBudget(const ErrorBudget& budget, ValidationResult& result);

}  // namespace ursula
