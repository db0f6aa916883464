#pragma once

#include <string>

#include "model/scenario.h"

namespace ursula {

struct MechanismPicture;

/// Returns the machine at the start of the motion, from the front and from above, as SVG. Legs that cannot reach that
/// pose are drawn without their knees.
std::string picture(const Scenario& scenario);

/// Returns a mechanism at the start of its motion, at an angle, from the front and from above, as SVG. `title` stands
/// above it.
std::string picture(const MechanismPicture& mechanism, const std::string& title);

}  // namespace ursula
