#pragma once

#include <optional>

#include "validation/external/hypotheses.h"

namespace ursula {

/// Torques of another time, τ(t + dt), with dt in ms and in samples. Judged by the samples whose other time is within
/// the motion; none where those are too few.
std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data);

}  // namespace ursula
