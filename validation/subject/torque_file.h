#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/scalar.h"
#include "validation/subject/torque_columns.h"

namespace ursula {

/// External torques at their own instants, and the precision of each printed number.
///
/// The uncertainty of a number is half a unit of the last digit that its writer could have printed. A writer prints all
/// numbers with equal decimals or equal significant digits, but may drop trailing zeros (like "%g"). So the precision
/// of a number is the finer of its own last digit and the coarser of these two interpretations of the file. A precision
/// finer than a double counts as exact.
///
/// Instants follow the same rule with two exceptions. Instants k·step are exact, since rounding would be visible
/// (0.333, 0.667, 1.000). Instants with visible rounding of their last digit count as rounded there, however fine the
/// torques are.
struct TorqueFile {
  std::filesystem::path file;
  bool is_read = false;                    ///< from the file; else a program gave the numbers
  std::vector<double> t;                   ///< s, finite, increasing
  std::vector<double> time_precision;      ///< s
  std::vector<Vector6d> torques;           ///< N·m or N, conjugate to the motors' rates
  std::vector<Vector6d> torque_precision;  ///< N·m or N
  std::vector<int> lines;                  ///< line of each row, 1-based
  std::vector<std::string> ignored;        ///< unknown columns
  std::string map;          ///< columns that the caller named, as options follow --map: "t_s=Clock --map tau_1_N=F1"
  std::string read_as;      ///< how columns were interpreted; empty for a file that follows the contract
  int digits = 0;           ///< largest number of significant digits of a torque
  bool all_single = false;  ///< every torque is a single-precision number, as printed
  /// Where the precision comes from, in words, if not from printed digits; such torques are compared at their instants
  /// and not replayed.
  std::string derived_from;

  std::size_t rows() const { return t.size(); }
};

/// Reads `t_s` and `tau_{1..6}_Nm` (`_N` for sliding motors) in any order, or the columns that readTorqueColumns()
/// finds. Throws CsvError (`file:line: error: …`) like that and readCsv, and for instants that repeat or decrease. By
/// default motors rotate.
TorqueFile readTorqueFile(const std::filesystem::path& file, const ColumnMap& map = {}, const Motors& motors = {});

/// The same from text; `file` names it in errors.
TorqueFile parseTorqueFile(const std::string& text, const std::filesystem::path& file, const ColumnMap& map = {},
                           const Motors& motors = {});

/// Torques from a program at its instants.
struct GivenTorques {
  std::string name;  ///< replaces a file's name
  std::vector<double> t;
  std::vector<Vector6d> torques;
};

/// Converts them as if from a file with the shortest text of each number, so numbers rounded to few digits are
/// recognised. Errors give the line in such a file, whose first line is the header.
TorqueFile torqueFileOf(const GivenTorques& table, const Motors& motors = {});

/// The possible error, s, of an instant near `duration` whose writer added one step at a time: half an eps per row, and
/// as much for the step's own rounding. At least four eps.
double timeRounding(const TorqueFile& file, double duration);

/// Returns the same torques with every instant in [0, duration]. Instants outside by rounding only (of doubles, or as
/// printed) move to the end. Otherwise throws CsvError with the line and the probable meaning of the instants.
TorqueFile within(TorqueFile file, double duration);

/// Whether the instants cover the motion, within the rounding of their digits and sums.
bool covers(const TorqueFile& file, double duration);

}  // namespace ursula
