#pragma once

#include "exchange/write/machine_model.h"

namespace ursula::exchange {

/// The scenario's machine at the first instant of its motion: a base, for each leg its links and, where two turning
/// coordinates follow each other, a cross of no mass between them, and the platform. The first leg carries the
/// platform by a ball; the others close their loops by one. Throws UnreachablePose.
MachineModel modelOf(const Scenario& scenario);

}  // namespace ursula::exchange
