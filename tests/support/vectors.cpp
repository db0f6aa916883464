#include "tests/support/vectors.h"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "model/real50.h"

namespace ursula {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

/// One row of the file by the names of its columns.
class Row {
 public:
  Row(const std::vector<std::string>& names, const std::vector<std::string>& values) {
    if (names.size() != values.size()) throw std::runtime_error("a vector's row is not as long as its header");
    for (std::size_t k = 0; k < names.size(); ++k) values_[names[k]] = values[k];
  }

  Real50 operator()(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw std::runtime_error("a vector lacks the column " + name);
    return Real50(found->second);
  }
  Vector3<Real50> axes(const std::string& before, const std::string& after) const {
    return {(*this)(before + "x" + after), (*this)(before + "y" + after), (*this)(before + "z" + after)};
  }
  Vector6<Real50> legs(const std::string& before, const std::string& after) const {
    Vector6<Real50> out;
    for (int i = 0; i < leg_count; ++i) out(i) = (*this)(before + std::to_string(i + 1) + after);
    return out;
  }
  JointVariables<Real50> joints(const std::string& rate, const std::string& unit) const {
    return {legs("phi" + rate, unit), legs("psi" + rate, unit), legs("theta" + rate, unit)};
  }
  Matrix3<Real50> rotation() const {
    const Real50 w = (*this)("q_w"), x = (*this)("q_x"), y = (*this)("q_y"), z = (*this)("q_z");
    const Real50 n = w * w + x * x + y * y + z * z;  // off 1 by its 25th digit
    Matrix3<Real50> Q;
    Q << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
        2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    return Q / n;
  }

 private:
  std::map<std::string, std::string> values_;
};

VectorRow vectorRow(const Row& row) {
  VectorRow out;
  out.motion.t = row("t_s");
  out.motion.p = row.axes("p_", "_m");
  out.motion.Q = row.rotation();
  out.motion.omega = row.axes("w_", "_rad_s");
  out.motion.p_dot = row.axes("v_", "_m_s");
  out.motion.omega_dot = row.axes("alpha_", "_rad_s2");
  out.motion.p_ddot = row.axes("a_", "_m_s2");
  out.q = row.joints("_", "_rad");
  out.q_dot = row.joints("dot_", "_rad_s");
  out.q_ddot = row.joints("ddot_", "_rad_s2");
  out.torques = row.legs("tau_", "_Nm");
  return out;
}

}  // namespace

const std::vector<std::string>& vectorNames() {
  static const std::vector<std::string> names = {"paper-helix", "random-1", "random-2", "random-3",
                                                 "random-4",    "random-5", "random-6"};
  return names;
}

std::vector<VectorRow> vectorRows(const std::string& name) {
  std::ifstream file(std::string(URSULA_VECTORS) + "/" + name + ".csv");
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("there are no vectors " + name);
  const std::vector<std::string> names = cells(line);
  std::vector<VectorRow> rows;
  while (std::getline(file, line)) rows.push_back(vectorRow(Row(names, cells(line))));
  if (rows.size() != 5) throw std::runtime_error(name + " does not have five instants");
  return rows;
}

Scenario vectorScenario(const std::string& name) {
  const std::string folder = name == "paper-helix" ? URSULA_SCENARIOS : URSULA_VECTORS;
  return readScenario(folder + "/" + name + ".toml");
}

Motion<double> rounded(const Motion<Real50>& motion) {
  Motion<double> out;
  out.t = static_cast<double>(motion.t);
  out.p = motion.p.cast<double>();
  out.Q = motion.Q.cast<double>();
  out.omega = motion.omega.cast<double>();
  out.p_dot = motion.p_dot.cast<double>();
  out.omega_dot = motion.omega_dot.cast<double>();
  out.p_ddot = motion.p_ddot.cast<double>();
  return out;
}

}  // namespace ursula
