#pragma once

#include "exchange/recognise/chains.h"
#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// Finds base, platform and legs in a model and reports the assumptions. Throws ImportError with the names of bodies
/// and joints that no supported machine has.
ImportedMachine recognise(ModelGraph graph, const ImportChoices& choices);

}  // namespace ursula::exchange
