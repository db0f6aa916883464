#pragma once

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// The kind of a motor's effort, as far as a column's name tells. Internal.
enum class EffortKind { untold, moment, force };

/// The time, or the effort of a motor, from an unambiguous column name.
struct ColumnMeaning {
  int motor = 0;  ///< −1 for the time; otherwise as numbered in the file
  int power = 0;  ///< power of ten from the name's unit to SI
  EffortKind kind = EffortKind::untold;

  /// Whether the unit is that of motor k, 0-based, or unknown.
  bool fits(const Motors& motors, int k) const {
    return kind == EffortKind::untold || (kind == EffortKind::force) == motors[static_cast<std::size_t>(k)].slides();
  }
};

/// Interprets `tau1`, `Tau 1 [Nm]`, `torque_1 (kN m)`, `force 2 [N]`, `t`, `Time [ms]`; nullopt for an ambiguous name.
std::optional<ColumnMeaning> meaningOf(const std::string& name);

/// Interprets a name of the contract, possibly with another unit: `tau_1_kNm`. Its motor is numbered from 0.
std::optional<ColumnMeaning> meaningOfTarget(const std::string& name);

/// "t_s" for −1, otherwise the column of that motor's effort.
std::string targetName(const Motors& motors, int k);
/// All seven names.
std::vector<std::string> targetNames(const Motors& motors);

/// "motor 3 slides, its efforts are 'tau_3_N' (N)".
std::string whatItTakes(const Motors& motors, int k);

/// "tau_3_Nm", or "tau_3_N" if motor k, 0-based, slides.
inline std::string effortColumn(const Motors& motors, int k) {
  return fmt::format("tau_{}_{}", k + 1, motors[static_cast<std::size_t>(k)].effortUnit());
}

/// "Nm", or "N" if all motors slide, for texts about all of them. A force then counts as a moment at a length of 1 m.
inline const char* effortSuffix(const Motors& motors) { return allSlide(motors) ? "N" : "Nm"; }

}  // namespace ursula
