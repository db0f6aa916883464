#pragma once

// Selects code by the kind of a leg. Internal.

#include <type_traits>

#include "model/leg_kind.h"

namespace ursula::kernel {

using Urs = std::integral_constant<LegKind, LegKind::URS>;
using Ups = std::integral_constant<LegKind, LegKind::UPS>;
using Rus = std::integral_constant<LegKind, LegKind::RUS>;
using Pus = std::integral_constant<LegKind, LegKind::PUS>;

/// Calls f with the leg's kind as a constant.
template <class F>
auto withKind(LegKind kind, const F& f) {
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

}  // namespace ursula::kernel
