#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "model/manipulator.h"

namespace ursula {

/// What a user says of a file's columns: pairs of a name (`t_s`, `tau_1_Nm`, …, or with another unit: `t_ms`,
/// `tau_1_kNm`; `tau_1_N` of a motor that slides) and a column's own name, or its number where there is no header.
using ColumnMap = std::vector<std::pair<std::string, std::string>>;

/// From texts `NAME=COLUMN`, the blanks around each dropped. Throws CsvError for a text without either side, a name
/// that no torque file of these motors has, and names or columns that come twice. Motors turn unless given.
ColumnMap parseColumnMap(const std::vector<std::string>& texts, const Motors& motors = {});

/// Which of a file's columns holds what.
struct TorqueColumn {
  std::string name;    ///< "t_s", "tau_3_Nm"
  std::string source;  ///< the file's own name
  int power = 0;       ///< of ten, from the file's unit to SI: 3 of kN·m
};

/// A torque file as a table of `t_s` and `tau_{1..6}_Nm`, or `_N` of motors that slide, in SI.
struct TorqueColumns {
  CsvTable table;
  std::string read_as;  ///< what was taken for what, in words; empty for a file as the contract has it
};

/// Finds the columns: those of the map, else those of the contract's names, else those whose meaning is certain
/// (`tau1`, `Tau 1 [Nm]`, `torque_1 (kN m)`, `t`, `time_s`, `Time [ms]`; counted from 1 or all six from 0). Seven
/// columns without a header are certain where the first has equal steps and begins at 0 and no other does. A unit that
/// is not the motor's is refused. Throws CsvError with the header found, the separator and, where the rest can be
/// named, the options that would read it.
TorqueColumns readTorqueColumns(const std::string& text, const std::filesystem::path& file, const ColumnMap& map,
                                const Motors& motors = {});

}  // namespace ursula
