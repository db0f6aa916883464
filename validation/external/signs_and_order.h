#pragma once

#include <optional>

#include "validation/external/hypotheses.h"

namespace ursula {

/// Tries every order of the legs with the best signs, in the unit that the torques' size suggests. Returns nullopt if
/// neither order nor signs differ.
std::optional<Hypothesis> signsAndOrder(const TorqueResidual& data);

}  // namespace ursula
