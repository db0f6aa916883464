#pragma once

#include "engines/loop_engine.h"

namespace ursula {

/// An engine's module exports this under the name ursula_engine_module. Modules are loaded on first use, because the
/// engines' libraries slow every start.
struct EngineModule {
  const char* version;  ///< the engine's version, "6.12.1"
  MakeLoopEngine* make;
};

}  // namespace ursula
