#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/csv_dialect.h"
#include "model/manipulator.h"

namespace ursula::identification {

enum class LogQuantity { time, driven, position, quaternion, effort, current, force, moment };

/// The meaning of one column of a log.
struct LogColumn {
  LogQuantity quantity = LogQuantity::time;
  int index = 0;                              ///< 0-based motor or entry of a vector
  double factor = 1;                          ///< factor to SI units, or to A
  std::size_t place = 0;                      ///< 0-based column of the file
  std::string name = {};                      ///< name in the file
  std::optional<Coordinate> coordinate = {};  ///< set for a leg's coordinate in the file; `index` is then the leg
};

/// The understood columns of a log.
struct LogColumns {
  std::vector<LogColumn> columns;
  std::vector<std::string> ignored;
  bool has_poses = false;     ///< whether poses, not driven coordinates, give the motion
  bool has_currents = false;  ///< whether currents give the efforts
  bool has_load = false;
  std::string read_as;  ///< the columns' meaning in words
};

/// Finds the meaning of a log's columns. `t_s` is time. Driven coordinates are `phi_1_rad`, `d_2_m`, or names that
/// count motors (`q1`, `encoder 3 [deg]`); otherwise poses `p_x_m` … `q_z` give the motion. Efforts are named as in
/// torque files; otherwise currents `i_1_A` give them. A load on the platform is `f_x_N` … `m_z_Nm`. `map` has pairs of
/// such a name and a column's own name. Throws CsvError with the found header and what is missing.
LogColumns findLogColumns(const CsvDialect& dialect, const std::string& file,
                          const std::vector<std::pair<std::string, std::string>>& map, const Manipulator& machine);

/// Returns the column name of the motor's driven coordinate, "phi_1_rad".
std::string drivenName(const Motor& motor);

}  // namespace ursula::identification
