#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/csv.h"
#include "model/motor_trajectory.h"
#include "parts/exchange/import.h"

namespace ursula {

/// The machine of tests/vectors/loops/NAME.xml.
inline MechanismParameters loopMachine(const std::string& name) {
  return exchange::readModel(std::string(URSULA_VECTORS) + "/loops/" + name + ".xml");
}

/// One row of NAME.csv.
struct LoopRow {
  MotorMotion motion;
  Eigen::VectorXd efforts;
};

inline std::vector<LoopRow> loopRows(const std::string& name, std::size_t motors) {
  const CsvTable table = readCsv(std::string(URSULA_VECTORS) + "/loops/" + name + ".csv");
  std::vector<LoopRow> out(table.rows());
  for (std::size_t row = 0; row < out.size(); ++row) {
    const auto read = [&](const char* what, const char* unit) {
      Eigen::VectorXd numbers(static_cast<Eigen::Index>(motors));
      for (std::size_t k = 0; k < motors; ++k)
        numbers(static_cast<Eigen::Index>(k)) = table.at(what + std::to_string(k + 1) + unit)[row];
      return numbers;
    };
    out[row].motion = {table.at("t_s")[row], read("q_", "_rad"), read("qdot_", "_rad_s"), read("qddot_", "_rad_s2")};
    out[row].efforts = read("tau_", "_Nm");
  }
  return out;
}

}  // namespace ursula
