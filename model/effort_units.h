#pragma once

#include <string>
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

/// The unit at the end of a column's name, as targets have it: "kN" of "F1 (kN)", "ms" of "Clock [ms]". That of the
/// contract if it has none; empty if it does not fit motor k, 0-based, −1 for the time.
std::string unitOfColumn(const std::string& name, const EffortAxes& motors, int k);

}  // namespace ursula
