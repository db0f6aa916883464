#pragma once

#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// The share of a leg's range, up to 1, that is left at a pose of M in B. It is not positive if the leg cannot take the
/// pose.
double reserveOf(const ImportedLeg& leg, const ImportedPose& pose);

/// Proposes a small helix of the platform's origin from the initial pose, with constant orientation. It is as large as
/// the legs allow, at most a twentieth of `size`. Throws ImportError if they cannot take the initial pose.
void proposeMotion(ImportedMachine& machine, double size);

}  // namespace ursula::exchange
