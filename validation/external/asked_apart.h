#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/likely_cause.h"

namespace ursula {

/// What a solver answers where it is asked for one thing at a time, at poses of its motion.
struct AskedApart {
  std::vector<Motion<double>> motions;
  std::vector<Vector6d> found, expected;  ///< of the solver, of the NOC: N·m or N
  std::vector<double> rounding;           ///< by how much right efforts may differ, N·m or N
  std::vector<TermError> terms;           ///< relative errors of the parts of its efforts
};

/// Asks at poses of `motions` for one thing at a time, and holds each part of the efforts against the NOC's: at rest,
/// the effect of each acceleration, what is even in v, in ω and in both, what is odd in them, and the first questions
/// again, in another order. Errors are relative to the part, or, where the part is nothing, to all efforts that were
/// asked. The velocities are such that their efforts show beside gravity's. Empty where the solver gives no answer to
/// one of the questions; without motions where its answers do not depend on what it is asked.
AskedApart askedApart(const Subject& subject, const Scenario& scenario, const std::vector<Motion<double>>& motions);

}  // namespace ursula
