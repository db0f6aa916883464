#pragma once

#include "exchange/write/machine_model.h"

namespace ursula::exchange {

/// Returns the scenario's machine at the first instant of its motion: a base, the legs' links and the platform. A
/// massless cross joins two consecutive turning coordinates. The first leg carries the platform by a ball; balls close
/// the loops of the others. Throws UnreachablePose.
MachineModel modelOf(const Scenario& scenario);

}  // namespace ursula::exchange
