#pragma once

#include "exchange/recognise/chains.h"
#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// Finds base, platform and legs in a model and says what was taken for granted. Throws ImportError with the names of
/// the bodies and joints that no machine of the program's has.
ImportedMachine recognise(ModelGraph graph, const ImportChoices& choices);

}  // namespace ursula::exchange
