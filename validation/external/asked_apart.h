#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/subject/subject.h"
#include "validation/verdict/likely_cause.h"

namespace ursula {

/// Asks a solver at poses of `motions` for one thing at a time, and holds each part of its efforts against the NOC's:
/// at rest, the effect of each acceleration, what is even in v, in ω and in both, what is odd in them, and the first
/// question again. Errors are relative to the part, or, where the part is nothing, to all efforts that were asked.
/// Empty where the solver gives no answer to one of the questions.
std::vector<TermError> askedApart(const Subject& subject, const Scenario& scenario,
                                  const std::vector<Motion<double>>& motions);

}  // namespace ursula
