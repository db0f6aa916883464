#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "examples/engines/closed_chain_internal.h"
#include "nocsolver/noc/noc.h"
#include "tests/exchange/export_support.h"

namespace ursula::exchange {

/// An exported machine in MuJoCo.
class InMujoco : public closed_chain::Machine {
 public:
  explicit InMujoco(const std::string& text) : closed_chain::Machine(written(text)) {}

  SeenBodies bodies() {
    gap();
    SeenBodies out;
    for (int body = 1; body < model().nbody; ++body) {
      const Matrix3d axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data().ximat + 9 * body);
      const Vector3d moments = Eigen::Map<const Vector3d>(model().body_inertia + 3 * body);
      out[mj_id2name(&model(), mjOBJ_BODY, body)] = {model().body_mass[body],
                                                     Eigen::Map<const Vector3d>(data().xipos + 3 * body),
                                                     axes * moments.asDiagonal() * axes.transpose()};
    }
    return out;
  }

 private:
  static std::string written(const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) /
                      (std::string("export_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".xml");
    std::ofstream(file) << text;
    return file.string();
  }
};

inline closed_chain::Motion asked(const Motion<double>& m) {
  return {m.p, m.p_dot, m.omega, m.p_ddot, m.omega_dot, Eigen::Quaterniond(m.Q)};
}

inline Vector6d expectedEfforts(const Scenario& scenario, double t) {
  NocWorkspace<double> work;
  return Noc<double>(*scenario.manipulator).inverseDynamics(scenario.trajectory->at(t), work);
}

}  // namespace ursula::exchange
