#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Returns `file:line:column: warning: key: …` for unusual but possible values, each with the suspicious number. A
/// value that all legs inherit gives one warning. If the motion is impossible (tryMotion), only the numbers are
/// checked.
std::vector<std::string> warnings(const Scenario& scenario);

/// Returns only the warnings for which another unit makes the number usual: "did you mean mm? …".
std::vector<std::string> hints(const Scenario& scenario);

/// Returns the machine at the start of the motion, from the front and from above, as SVG. Legs that cannot reach that
/// pose are drawn without their knees.
std::string picture(const Scenario& scenario);

}  // namespace ursula
