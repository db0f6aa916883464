#pragma once

#include <string>
#include <vector>

#include "apps/verbs.h"

namespace ursula {

/// The verbs of the parts in this build. CMake writes both definitions from the rows of parts/CMakeLists.txt.
const std::vector<AddVerb*>& partVerbs();

/// The names of the verbs of all parts, also of those that this build lacks.
const std::vector<std::string>& verbsOfParts();

}  // namespace ursula
