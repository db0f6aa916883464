#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "model/mechanism.h"

namespace ursula {

/// Splits an entry NAME=COLUMN of the user's map, without blanks around each; a missing part is empty. The column is in
/// UTF-8, as a header is.
std::pair<std::string, std::string> mapEntry(std::string_view text);

/// The understood columns of a file with the motion of a mechanism's motors.
struct MotorTable {
  CsvTable table;                   ///< by the contract's names, in SI: t_s, q_1_rad, qdot_2_m_s
  std::vector<double> half_digits;  ///< half a unit of the last printed digit of each column, in its unit
  std::string read_as;              ///< what was taken for what, in words; empty for a file by the contract
  std::vector<std::string> mapped;  ///< those entries of the map whose columns the file has
};

/// Reads t_s and q_k, qdot_k, qddot_k of each motor k, by number or by the joint's own name, also in ms, us, deg and
/// mm. `map` has entries NAME=COLUMN, where NAME is such a name; an entry whose column the file lacks is passed over.
/// If several columns hold one quantity, a mapped column comes first, a numbered one second, one in SI third. Throws
/// CsvError, also for a missing coordinate, and for a missing time if `has_time`.
MotorTable readMotorTable(const std::filesystem::path& file, const Mechanism& mechanism,
                          const std::vector<std::string>& map = {}, bool has_time = true);

}  // namespace ursula
