#pragma once

#include <memory>

#include "engines/loop_engine.h"

namespace ursula {

/// The DART module exports this under the name ursula_dart_module.
struct DartModule {
  const char* version;  ///< DART's version, "6.12.1"
  MakeLoopEngine* make;
};

}  // namespace ursula
