#pragma once

#include "model/scenario.h"
#include "nocsolver/errors.h"

namespace ursula {

/// Throws InvalidParameter unless there are a machine and a motion: a scenario that was moved from has none.
void requireWhole(const Scenario& scenario);

/// Throws as requireWhole does, and PoseError where the commanded motion cannot be made: a leg out of reach, stretched,
/// folded or off its base's side, or a singular pose, which is passed wherever the sign of det B changes. Looked at are
/// the scenario's samples and instants between them, 2,000 or more, for replays pass there, too.
void checkMotion(const Scenario& scenario);

/// The same refusal for people, at the scenario's [trajectory]: `file:line:column: error: the motion cannot be made:
/// leg 3 …`, with the instant and how far it misses, there and where the motion misses most.
ScenarioError unmade(const Scenario& scenario, const PoseError& refusal);

/// checkMotion, whose refusal is that of `unmade`.
void tryMotion(const Scenario& scenario);

}  // namespace ursula
