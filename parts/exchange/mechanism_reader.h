#pragma once

#include <filesystem>

#include "model/mechanism_scenario.h"

namespace ursula::exchange {

/// Reads a model as a mechanism. Joints that are no `closure` form a tree from what stands still; a body that floats
/// hangs on it by a free joint, and one that floats alone, without a motor, is left out. Both lists of the result have
/// whole sentences (inWords). Throws ImportError with the file's place, and InvalidParameter (places `mechanism.…`) for
/// choices that the file does not have.
ModelRead readMechanismModel(const std::filesystem::path& file, const MechanismChoices& choices);

}  // namespace ursula::exchange
