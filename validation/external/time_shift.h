#pragma once

#include <optional>

#include "validation/external/hypotheses.h"

namespace ursula {

/// Finds torques of another time, τ(t + dt), with dt in ms and in samples. Uses the samples whose shifted time is
/// within the motion; returns nullopt if they are too few.
std::optional<Hypothesis> timeShift(const Scenario& scenario, const TorqueResidual& data);

}  // namespace ursula
