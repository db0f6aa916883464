#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "model/manipulator.h"

namespace ursula {

enum class ColumnQuantity { time, driven, position, quaternion, angle, effort, current, force, moment };

/// The meaning of one column.
struct Column {
  ColumnQuantity quantity = ColumnQuantity::time;
  int index = 0;                              ///< 0-based motor or entry of a vector
  double factor = 1;                          ///< factor to SI units, or to A
  std::size_t place = 0;                      ///< 0-based column of the file
  std::string name = {};                      ///< name in the file
  std::optional<Coordinate> coordinate = {};  ///< set for a leg's coordinate in the file; `index` is then the leg
};

/// Interprets one column's name: `t_ms`, `phi_1_rad`, `encoder 3 [deg]`, `surge_mm`, `yaw_deg`, `tau_2_Nm`, `f_x_N`.
/// Motors and legs are numbered as in the file; `place` and `name` stay empty. Returns nullopt for an ambiguous name.
std::optional<Column> meaningOfColumn(const std::string& name);

/// Returns the column name of the motor's driven coordinate, "phi_1_rad".
std::string drivenName(const Motor& motor);

/// Returns the contract's name of a quantity's column k, 0-based: "p_x_m", "tau_3_Nm".
std::string contractName(ColumnQuantity quantity, int k, const Motors& motors);

}  // namespace ursula
