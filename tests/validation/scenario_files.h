#pragma once

#include <algorithm>
#include <vector>

#include "model/instants.h"
#include "tests/support/vectors.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/subject.h"
#include "validation/validate.h"

namespace ursula {

inline Subject solverOf(const Scenario& scenario) { return nocSubject(*scenario.manipulator, scenario.load); }

/// The solver's pointwise samples at equally spaced instants.
inline std::vector<PointwiseSample> rightSamples(const Scenario& scenario, int count) {
  return runPointwise(scenario, solverOf(scenario), equallySpaced(scenario.trajectory->duration(), count));
}

}  // namespace ursula
