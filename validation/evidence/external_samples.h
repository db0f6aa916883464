#pragma once

#include "model/scenario.h"
#include "validation/evidence/external_torques.h"

namespace ursula {

/// Compares at the file's own instants, so that nothing is interpolated.
ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file);

}  // namespace ursula
