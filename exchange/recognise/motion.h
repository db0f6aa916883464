#pragma once

#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// How near a leg is to the end of what it can do at a pose of M in B: the share of its range that is left, of 1; not
/// above zero where it cannot take the pose.
double reserveOf(const ImportedLeg& leg, const ImportedPose& pose);

/// A small helix of the platform's origin from the initial pose, its orientation kept, as large as the legs can follow
/// it up to a twentieth of `size`. Throws ImportError where they cannot even take the initial pose.
void proposeMotion(ImportedMachine& machine, double size);

}  // namespace ursula::exchange
