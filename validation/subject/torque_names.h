#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/manipulator.h"

namespace ursula {

/// What a motor's effort is measured in, as far as a column's name tells. Internal.
enum class EffortKind { untold, moment, force };

/// The time, or the effort of a motor, by a column's name that can mean nothing else.
struct ColumnMeaning {
  int motor = 0;  ///< −1: the time; else as counted by the file
  int power = 0;  ///< of ten, from the name's unit to SI
  EffortKind kind = EffortKind::untold;

  /// No other unit than the motor's, 0-based.
  bool fits(const Motors& motors, int k) const {
    return kind == EffortKind::untold || (kind == EffortKind::force) == motors[static_cast<std::size_t>(k)].slides();
  }
};

/// Of `tau1`, `Tau 1 [Nm]`, `torque_1 (kN m)`, `force 2 [N]`, `t`, `Time [ms]`; none where a name is not certain.
std::optional<ColumnMeaning> meaningOf(const std::string& name);

/// Of a name of the contract, which may have another unit: `tau_1_kNm`; counted from 0.
std::optional<ColumnMeaning> meaningOfTarget(const std::string& name);

/// "t_s" for −1, else the column of that motor's effort.
std::string targetName(const Motors& motors, int k);
/// All seven.
std::vector<std::string> targetNames(const Motors& motors);

/// "motor 3 slides, its efforts are 'tau_3_N' (N)".
std::string whatItTakes(const Motors& motors, int k);

}  // namespace ursula
