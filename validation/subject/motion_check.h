#pragma once

#include "model/scenario.h"

namespace ursula {

/// Throws PoseError where the commanded motion cannot be made: a leg out of reach, stretched, folded or off its base's
/// side, or a singular pose, which is passed wherever the sign of det B changes. Looked at are the scenario's samples
/// and instants between them, 2,000 or more, for replays pass there, too.
void checkMotion(const Scenario& scenario);

}  // namespace ursula
