#pragma once

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_file.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Adds the likely cause of wrong efforts to the result of a failure. `scenario` and `efforts` are in SI, with positions
/// relative to the natural origin. `solver` is what gave the efforts, for further questions; null for those of a file,
/// or if time ran out.
using AddLikelyCause = void(const Scenario& scenario, const TorqueFile& efforts, const Subject* solver,
                            ValidationResult& result);

/// Null if no part of this build finds causes. CMake writes the definition (cmake/parts.cmake), once for each program.
AddLikelyCause* partLikelyCause();

}  // namespace ursula
