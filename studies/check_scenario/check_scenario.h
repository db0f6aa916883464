#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// `file:line:column: warning: key: …` for what is possible in a scenario but odd, each with the number that made it
/// suspicious; one where all legs inherit one value. Of a motion that cannot be made (tryMotion), what its numbers
/// alone say.
std::vector<std::string> warnings(const Scenario& scenario);

/// The machine at the start of the motion, from the front and from above, as SVG. Where the legs cannot reach that
/// pose, they are drawn without their knees.
std::string picture(const Scenario& scenario);

}  // namespace ursula
