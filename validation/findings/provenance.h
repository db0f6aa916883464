#pragma once

#include <string>

namespace ursula {

/// What this build was made of. Goes with every result.
struct BuildProvenance {
  std::string version;     ///< of the project
  std::string commit;      ///< full hash, "-dirty" if a tracked source differed from it, "unknown" outside a checkout
  std::string compiler;    ///< "GNU 12.2.0"
  std::string flags;       ///< those that bear on code generation: language standard, build type, sanitizers
  std::string build_type;  ///< "Release"
  std::string eigen, boost, simbody;  ///< library versions
};

/// The same object at every call; computed once, at the first.
const BuildProvenance& buildProvenance();

}  // namespace ursula
