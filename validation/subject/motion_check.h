#pragma once

#include "model/scenario.h"
#include "nocsolver/errors.h"

namespace ursula {

/// Throws InvalidParameter unless there are a machine and a motion; a moved-from scenario has none.
void requireWhole(const Scenario& scenario);

/// Throws like requireWhole, and PoseError if the commanded motion is impossible. A leg may be out of reach, stretched
/// or folded, or have its platform point on its first axis; a pose may be singular, which a sign change of det B
/// reveals. It checks the scenario's samples and instants between them, 2,000 or more, because replays pass there, too.
void checkMotion(const Scenario& scenario);

/// Returns the same error for people, at the scenario's [trajectory]: `file:line:column: error: the motion cannot be
/// made: leg 3 …`. It gives the instant and the violation there, and where the violation is largest. A machine that is
/// singular in every pose is named at its legs.
ScenarioError motionRefusal(const Scenario& scenario, const PoseError& refusal);

/// Calls checkMotion and throws its error in the form of `motionRefusal`.
void tryMotion(const Scenario& scenario);

}  // namespace ursula
