#pragma once

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

#include "model/effort_axes.h"

namespace ursula {

/// The kind of a motor's effort, as far as a column's name tells. Internal.
enum class EffortKind { untold, moment, force };

/// The time, or the effort of a motor, from an unambiguous column name.
struct ColumnMeaning {
  int motor = 0;  ///< −1 for the time; otherwise as numbered in the file
  EffortKind kind = EffortKind::untold;
  int power = 0;          ///< power of ten from the name's unit to SI
  double multiplier = 1;  ///< beside the power: 9.80665 for kgf

  /// Whether the unit is that of motor k, 0-based, or unknown.
  bool fits(const EffortAxes& motors, int k) const {
    return kind == EffortKind::untold || (kind == EffortKind::force) == motors[k].slides;
  }
};

/// Interprets `tau1`, `Tau 1 [Nm]`, `torque_1 (kN m)`, `Motor 1 torque (kNm)`, `tau_2_kgfcm`, `force 2 [lbf]`, `t`,
/// `Time [ms]`; nullopt for an ambiguous name.
std::optional<ColumnMeaning> meaningOf(const std::string& name);

/// Interprets `tau_JOINT_kNm`, `JOINT_Nm` or `JOINT torque (kN m)`, numbered from 0; nullopt for any other name.
std::optional<ColumnMeaning> meaningByJoint(const std::string& name, const EffortAxes& motors);

/// Interprets a name of the contract, possibly with another unit: `tau_1_kNm`. Its motor is numbered from 0.
std::optional<ColumnMeaning> meaningOfTarget(const std::string& name, const EffortAxes& motors);

/// "t_s" for −1, otherwise the column of that motor's effort.
std::string targetName(const EffortAxes& motors, int k);
/// The time's, then those of all motors.
std::vector<std::string> targetNames(const EffortAxes& motors);

/// "motor 3 slides, its efforts are 'tau_3_N' (N)".
std::string whatItTakes(const EffortAxes& motors, int k);

/// "tau_3_Nm", or "tau_3_N" if motor k, 0-based, slides.
inline std::string effortColumn(const Motors& motors, int k) {
  return fmt::format("tau_{}_{}", k + 1, motors[k].effortUnit());
}

/// "Nm", or "N" if all motors slide, for texts about all of them. A force then counts as a moment at a length of 1 m.
inline const char* effortSuffix(const Motors& motors) { return allSlide(motors) ? "N" : "Nm"; }

}  // namespace ursula
