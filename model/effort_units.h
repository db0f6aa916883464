#pragma once

#include <vector>

#include "model/torque_names.h"

namespace ursula {

/// A unit of efforts, without what stands between its parts and in small letters, but for mega and milli.
struct EffortUnit {
  std::vector<const char*> spellings;
  EffortKind kind;
  int power;
  double multiplier;      ///< 1 for newtons
  const char* name = "";  ///< for texts; empty for newtons

  /// Its size, N·m or N.
  double inSI() const;
};

/// All units that a column's name may have.
const std::vector<EffortUnit>& effortUnits();

}  // namespace ursula
