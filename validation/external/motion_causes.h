#pragma once

#include <vector>

#include "validation/external/cause.h"

namespace ursula {

/// The motion read otherwise: turned the other way, in the platform's frame, of another point, without a part; what
/// belongs to the platform used without being turned; inertias of the motors.
std::vector<Cause> motionCauses(const Scenario& scenario);

}  // namespace ursula
