#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "validation/subject/torque_columns.h"

namespace ursula {

/// Somebody else's torques at their own instants, and how finely each number was printed.
///
/// Half a unit of the last digit that its writer could have printed is what a number may be off by. A writer prints all
/// numbers with as many decimals or as many significant digits, but may drop zeros at the end ("%g" does): so a number
/// counts as printed to the finer of its own last digit and the coarser of these two readings of the whole file. Where
/// that is finer than a double it counts as exact. Instants count the same, with two exceptions: instants k·step are
/// exact, since rounding would show (0.333, 0.667, 1.000); and such as show rounding of their last digit count as
/// rounded there, however fine the torques beside them are.
struct TorqueFile {
  std::filesystem::path file;
  std::vector<double> t;                   ///< s, finite, increasing
  std::vector<double> time_precision;      ///< s
  std::vector<Vector6d> torques;           ///< N·m or N, conjugate to the motors' rates
  std::vector<Vector6d> torque_precision;  ///< N·m or N
  std::vector<int> lines;                  ///< of each row, 1-based
  std::vector<std::string> ignored;        ///< columns that are none of ours
  std::string read_as;                     ///< what was taken for what; empty for a file as the contract has it
  int digits = 0;                          ///< most significant digits of a torque
  bool all_single = false;                 ///< every torque is a number of single precision

  std::size_t rows() const { return t.size(); }
};

/// Reads `t_s` and `tau_{1..6}_Nm`, `_N` of motors that slide, in any order, or what readTorqueColumns() takes for
/// them. Throws CsvError (`file:line: error: …`) as that and readCsv do, and for instants that repeat or do not
/// increase. Motors turn unless given.
TorqueFile readTorqueFile(const std::filesystem::path& file, const ColumnMap& map = {}, const Motors& motors = {});

/// The same from text; `file` names it in errors.
TorqueFile parseTorqueFile(const std::string& text, const std::filesystem::path& file, const ColumnMap& map = {},
                           const Motors& motors = {});

/// A program's own torques at its instants.
struct GivenTorques {
  std::string name;  ///< in the place of a file's
  std::vector<double> t;
  std::vector<Vector6d> torques;
};

/// As a file of these numbers is read that gives each by its shortest text: numbers that were rounded to few digits
/// count as such. Lines in errors are those of that file, whose first is the header.
TorqueFile torqueFileOf(const GivenTorques& table, const Motors& motors = {});

/// What an instant near `duration` may be off by where its writer added one step to the instant before, s: half an eps
/// for each row, and as much again for the step's own rounding. At least four eps.
double timeRounding(const TorqueFile& file, double duration);

/// The same torques with every instant in [0, duration]: those beyond by no more than rounding (of doubles, and as
/// printed) are put on the end. Throws CsvError naming the line of one that is further out,
/// and what the instants look like.
TorqueFile within(TorqueFile file, double duration);

/// The instants reach from the start of a motion to its end, within the rounding of their digits and of sums.
bool covers(const TorqueFile& file, double duration);

}  // namespace ursula
