#pragma once

#include <vector>

#include "validation/external/cause.h"

namespace ursula {

/// Other interpretations of the motion: inverse rotation, the platform's frame, another point, a missing part. Also
/// platform quantities used without rotation, and inertias of the motors.
std::vector<Cause> motionCauses(const Scenario& scenario);

}  // namespace ursula
