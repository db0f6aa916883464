#include "validation/verdict/likely_cause.h"

#include <cstddef>

namespace ursula {

const char* name(CauseKind kind) {
  static constexpr const char* names[] = {"scale",        "sign",   "order",    "units",     "offset",
                                          "delay",        "digits", "state",    "parameter", "reference_point",
                                          "missing_term", "frame",  "jacobian", "closure",   "window"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace ursula
