#pragma once

#include "model/scenario.h"
#include "validation/evidence/external_torques.h"

namespace ursula {

/// Pointwise at the file's own instants: there is nothing to interpolate.
ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file);

}  // namespace ursula
