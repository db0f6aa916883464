#include "tests/support/vectors.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "base/real50.h"

namespace ursula {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

/// One row of the file, accessed by column names.
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
  /// Zero for a leg without such a column; the caller must check that any exists.
  Vector6<Real50> legs(const std::string& before, const std::string& after) const {
    Vector6<Real50> out = Vector6<Real50>::Zero();
    for (int i = 0; i < leg_count; ++i)
      if (const auto found = values_.find(before + std::to_string(i + 1) + after); found != values_.end())
        out(i) = Real50(found->second);
    return out;
  }
  JointVariables<Real50> joints(const std::string& rate, const std::string& turning, const std::string& sliding) const {
    return {legs("phi" + rate, turning), legs("psi" + rate, turning), legs("theta" + rate, turning),
            legs("d" + rate, sliding)};
  }
  /// The efforts of the six motors, in N·m or N.
  Vector6<Real50> efforts() const {
    Vector6<Real50> out;
    for (int k = 0; k < motor_count; ++k) {
      const std::string name = "tau_" + std::to_string(k + 1);
      out(k) = (*this)(name + (values_.count(name + "_N") > 0 ? "_N" : "_Nm"));
    }
    return out;
  }
  Matrix3<Real50> rotation() const {
    const Real50 w = (*this)("q_w"), x = (*this)("q_x"), y = (*this)("q_y"), z = (*this)("q_z");
    const Real50 n = w * w + x * x + y * y + z * z;  // differs from 1 in its 25th digit
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
  out.q = row.joints("_", "_rad", "_m");
  out.q_dot = row.joints("dot_", "_rad_s", "_m_s");
  out.q_ddot = row.joints("ddot_", "_rad_s2", "_m_s2");
  out.torques = row.efforts();
  return out;
}

}  // namespace

const std::vector<std::string>& vectorNames() {
  static const std::vector<std::string> names = {"paper-helix", "random-1", "random-2", "random-3",
                                                 "random-4",    "random-5", "random-6"};
  return names;
}

const std::vector<std::string>& kindNames() {
  static const std::vector<std::string> names = {"kind-ups-1",     "kind-ups-2",
                                                 "kind-rus-1",     "kind-rus-2",
                                                 "kind-pus-1",     "kind-pus-2",
                                                 "kind-mixture",   "kind-three-ups",
                                                 "kind-three-rus", "kind-three-mixed",
                                                 "kind-four",      "kind-five",
                                                 "kind-friction",  "kind-friction-two-motors",
                                                 "kind-load-base", "kind-load-platform"};
  return names;
}

std::vector<std::string> allNames() {
  std::vector<std::string> out = kindNames();
  out.insert(out.end(), vectorNames().begin(), vectorNames().end());
  return out;
}

std::vector<VectorRow> vectorRows(const std::string& name) {
  std::ifstream file(std::string(URSULA_VECTORS) + "/" + name + ".csv");
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("there are no vectors " + name);
  const std::vector<std::string> names = cells(line);
  std::vector<VectorRow> rows;
  while (std::getline(file, line)) rows.push_back(vectorRow(Row(names, cells(line))));
  const std::size_t instants = name.rfind("kind-", 0) == 0 ? 7 : 5;
  if (rows.size() != instants) throw std::runtime_error(name + " does not have all instants");
  return rows;
}

Scenario vectorScenario(const std::string& name) {
  const std::string folder = name == "paper-helix" ? URSULA_SCENARIOS : URSULA_VECTORS;
  return readScenario(folder + "/" + name + ".toml");
}

Scenario scenarioOf(const std::string& name) {
  const std::string file = std::string(URSULA_SCENARIOS) + "/" + name + ".toml";
  return std::filesystem::exists(file) ? readScenario(file) : vectorScenario(name);
}

std::vector<std::string> shippedScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(URSULA_SCENARIOS))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace ursula
