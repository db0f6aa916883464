#pragma once

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/evidence/external_torques.h"

namespace ursula {

/// Compares at the file's own instants, so that nothing is interpolated.
ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file, const Deadline& deadline = {});

}  // namespace ursula
