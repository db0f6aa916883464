#pragma once

#include <optional>

#include "validation/external/hypotheses.h"

namespace ursula {

/// Every order of the legs, with the sign of each that fits best, in the unit that the torques' size tells. None where
/// neither order nor signs differ.
std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data);

}  // namespace ursula
