#pragma once

#include "model/manipulator.h"
#include "validation/checks/written_numbers.h"

namespace ursula::written {

/// `[manipulator]` as its file has it. Internal.
ManipulatorParameters machineOf(const View& table);

}  // namespace ursula::written
