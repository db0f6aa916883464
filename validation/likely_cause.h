#pragma once

#include "model/scenario.h"
#include "validation/evidence/evidence.h"
#include "validation/subject/subject.h"
#include "validation/subject/torque_file.h"
#include "validation/verdict/result.h"

namespace ursula {

/// A solver that gave wrong efforts.
struct WrongSolver {
  const Subject& in_si;       ///< answers questions in SI, with positions relative to the natural origin
  const Subject& natural;     ///< the same in the evidence's units, with all its answers
  const Evidence& evidence;   ///< of the solver; if time ran out, it is asked no further
  std::string no_cause = {};  ///< what its answers say by themselves: then no cause is sought, and nothing is asked
};

/// Adds the likely cause of wrong efforts to the result of a failure. `scenario` and `efforts` are in SI, with
/// positions relative to the natural origin. `solver` is null for efforts of a file.
using AddLikelyCause = void(const Scenario& scenario, const TorqueFile& efforts, const WrongSolver* solver,
                            ValidationResult& result);

/// Null if no part of this build finds causes. CMake writes the definition (cmake/parts.cmake), once for each program.
AddLikelyCause* partLikelyCause();

}  // namespace ursula
