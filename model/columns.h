#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/csv.h"
#include "model/column_meaning.h"
#include "model/manipulator.h"

// What the columns of a file of numbers mean: of motions, loads and logs. Files of efforts have rules of their own for
// names that are not certain (validation/subject/torque_columns.h).

namespace ursula {

/// The understood columns of a file.
struct Columns {
  std::vector<Column> columns;
  std::vector<std::string> ignored;
  bool has_poses = false;     ///< whether poses, not driven coordinates, give the motion
  bool has_angles = false;    ///< whether roll, pitch and yaw give their orientation, Q = R_z(yaw) R_y(pitch) R_x(roll)
  bool has_currents = false;  ///< whether currents give the efforts
  bool has_load = false;
  std::string read_as;  ///< the columns' meaning in words; of a motion or load only what is not by the contract
};

/// Finds the meaning of a log's columns. Time is `t_s`, `Time [ms]`. Driven coordinates are `phi_1_rad`, `d_2_m`, or
/// names that count motors (`q1`, `encoder 3 [deg]`); otherwise poses give the motion: `p_x_m` or `surge_mm`, and `q_w`
/// or `roll_deg`. Efforts are named as in torque files; otherwise currents `i_1_A` give them. A load on the platform is
/// `f_x_N` … `m_z_Nm`. `map` has pairs of such a name and a column's own name. Of two columns of one meaning that of
/// the map is taken, then that of the contract. Throws CsvError for others, for a name twice, and with the header for
/// what is missing from the nearest alternative.
Columns findLogColumns(const CsvDialect& dialect, const std::string& file,
                       const std::vector<std::pair<std::string, std::string>>& map, const Manipulator& machine);

/// Reads a motion, `t_s` and poses, or with `loads` a load, `t_s`, `f_x_N` … `m_z_Nm`, in any dialect and unit of
/// findLogColumns. Returns these columns alone, by the contract's names and in SI; orientations as `q_w` … `q_z`.
/// Throws CsvError.
CsvTable readByMeaning(const std::filesystem::path& file, bool loads);

/// Returns what readByMeaning() takes for what in such a file; empty for a file by the contract.
std::string meaningInWords(const std::filesystem::path& file, bool loads);

/// Returns the unit quaternion [w, x, y, z] of roll, pitch and yaw, rad: R_z(yaw) R_y(pitch) R_x(roll), to rounding.
Eigen::Vector4d quaternionOfAngles(const Vector3d& roll_pitch_yaw);

}  // namespace ursula
