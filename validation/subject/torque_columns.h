#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "model/effort_axes.h"

namespace ursula {

/// The user's mapping of a file's columns: pairs of a name and the column's own name, or its number without a header.
/// Names are `t_s`, `tau_1_Nm`, …, with other units `t_ms`, `tau_1_kNm`, and `tau_1_N` for a sliding motor.
using ColumnMap = std::vector<std::pair<std::string, std::string>>;

/// Parses texts `NAME=COLUMN` and drops blanks around each part. Throws CsvError for a missing part, a name that no
/// torque file of these motors has, and repeated names or columns. By default motors rotate.
ColumnMap parseColumnMap(const std::vector<std::string>& texts, const EffortAxes& motors = Motors{});

/// The meaning of one of a file's columns.
struct TorqueColumn {
  std::string name;       ///< "t_s", "tau_3_Nm"
  std::string source;     ///< the file's own name
  int power = 0;          ///< power of ten from the file's unit to SI: 3 for kN·m
  double multiplier = 1;  ///< beside the power: 9.80665 for kgf
};

/// A torque file as a table of `t_s` and `tau_{1..n}_Nm`, or `_N` for sliding motors, in this order.
struct TorqueColumns {
  CsvTable table;                   ///< in SI but for the multipliers, so that its digits are those of the file
  std::vector<double> multipliers;  ///< of each column
  std::string read_as;      ///< how columns were interpreted, in words; empty for a file that follows the contract
  bool all_single = false;  ///< whether every effort is a single-precision number, as printed
};

/// Finds the columns by the map, else by the contract's names, else by names with a certain meaning. Such names are
/// `tau1`, `Tau 1 [Nm]`, `torque_1 (kN m)`, `tau_1_kgfcm`, `t`, `time_s`, `Time [ms]`, numbered from 1, or all from 0,
/// and `tau_JOINT_Nm`. As many columns without a header as time and motors are certain if only the first has equal
/// steps and begins at 0. A unit that does not fit the motor is refused. Throws CsvError with the header, the separator
/// and, if the rest can be named, the options that would read it.
TorqueColumns readTorqueColumns(const std::string& text, const std::filesystem::path& file, const ColumnMap& map,
                                const EffortAxes& motors = Motors{});

}  // namespace ursula
