#pragma once

#include <string>

namespace ursula {

/// The components of this build; every result contains them.
struct BuildProvenance {
  std::string version;     ///< of the project
  std::string commit;      ///< full hash, "-dirty" if a tracked source differed from it, "unknown" outside a checkout
  std::string compiler;    ///< "GNU 12.2.0"
  std::string flags;       ///< flags that affect code generation: language standard, build type, sanitizers
  std::string build_type;  ///< "Release"
  std::string eigen, boost, simbody;  ///< library versions
};

/// Returns the same object at every call; it is computed once.
const BuildProvenance& buildProvenance();

}  // namespace ursula
