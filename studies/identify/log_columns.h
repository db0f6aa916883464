#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/csv_dialect.h"
#include "model/manipulator.h"

namespace ursula::identification {

enum class LogQuantity { time, driven, position, quaternion, effort, current, force, moment };

/// Which column of a log holds what.
struct LogColumn {
  LogQuantity quantity = LogQuantity::time;
  int index = 0;          ///< motor, or entry of the vector; 0-based
  double factor = 1;      ///< to SI, or to A
  std::size_t place = 0;  ///< in the file, 0-based
  std::string name;       ///< the file's own
};

/// The columns of a log that are understood.
struct LogColumns {
  std::vector<LogColumn> columns;
  std::vector<std::string> ignored;
  bool has_poses = false;     ///< the platform's motion is by poses, not by driven coordinates
  bool has_currents = false;  ///< efforts are currents
  bool has_load = false;
  std::string read_as;  ///< what was taken for what, in words
};

/// What the columns of a log mean: `t_s`; driven coordinates, `phi_1_rad`, `d_2_m`, or those that a name counts by
/// motor (`q1`, `encoder 3 [deg]`); else poses, `p_x_m` … `q_z`; efforts, as a file of torques has them, else currents
/// `i_1_A`; a load on the platform, `f_x_N` … `m_z_Nm`. `map` has pairs of such a name and a column's own. Throws
/// CsvError with the header found and what is missing.
LogColumns findLogColumns(const CsvDialect& dialect, const std::string& file,
                          const std::vector<std::pair<std::string, std::string>>& map, const Manipulator& machine);

/// "phi_1_rad": the name of what motor k drives.
std::string drivenName(const Motor& motor);

}  // namespace ursula::identification
