#pragma once

#include <memory>

#include "engines/loop_engine.h"

namespace ursula {

/// What the module of DART exports under the name ursula_dart_module.
struct DartModule {
  const char* version;  ///< of DART, "6.12.1"
  MakeLoopEngine* make;
};

}  // namespace ursula
