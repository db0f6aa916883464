#pragma once

#include <string>

#include "model/scenario.h"

namespace ursula {

/// Returns the machine at the start of the motion, from the front and from above, as SVG. Legs that cannot reach that
/// pose are drawn without their knees.
std::string picture(const Scenario& scenario);

}  // namespace ursula
