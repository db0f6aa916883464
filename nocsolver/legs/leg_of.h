#pragma once

// Selects the class of a leg's kind; each kind's file has its `classOf`. Internal.

#include "nocsolver/legs/pus.h"
#include "nocsolver/legs/rus.h"
#include "nocsolver/legs/ups.h"
#include "nocsolver/legs/urs.h"

namespace ursula::legs {

/// Calls f with the class of the leg's kind.
template <class F>
auto withLeg(LegKind kind, const F& f) {
  return withKind(kind, [&f](auto constant) { return f(classOf(constant)); });
}

}  // namespace ursula::legs
