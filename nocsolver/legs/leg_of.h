#pragma once

// Selects the class of a leg's kind. Internal.

#include "nocsolver/legs/pus.h"
#include "nocsolver/legs/rus.h"
#include "nocsolver/legs/ups.h"
#include "nocsolver/legs/urs.h"

namespace ursula::legs {

/// Calls f with the class of the leg's kind.
template <class F>
auto withLeg(LegKind kind, const F& f) {
  switch (kind) {
    case LegKind::UPS:
      return f(Ups{});
    case LegKind::RUS:
      return f(Rus{});
    case LegKind::PUS:
      return f(Pus{});
    case LegKind::URS:
      break;
  }
  return f(Urs{});
}

}  // namespace ursula::legs
