// `ursula simulate`: it returns the commanded motion, and reports a motion that does not reach its end.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

class Simulate : public testing::TestWithParam<std::string> {
 protected:
  /// The right torques times `factor`, up to `end`, s.
  std::string torquesTimes(double factor, double end = 3) const {
    const CsvTable right = parseCsv(ursula_("inverse " + helix + " --samples 61").out, "stdout");
    std::ofstream out(file_);
    out.precision(17);
    out << "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_Nm,tau_6_Nm\n";
    for (std::size_t k = 0; k < right.rows() && right.at("t_s")[k] <= end; ++k) {
      out << right.at("t_s")[k];
      for (int i = 1; i <= 6; ++i) out << ',' << factor * right.at("tau_" + std::to_string(i) + "_Nm")[k];
      out << '\n';
    }
    return "'" + file_ + "'";
  }
  UrsulaRun simulate(const std::string& torques) const {
    return ursula_("simulate " + helix + " --engine " + GetParam() + " --torques " + torques);
  }

  const Program ursula_{};
  const std::string file_ =
      testing::TempDir() + "/simulate_" + std::to_string(::getpid()) + ".csv";  // because tests run at once
};

TEST_P(Simulate, theRightTorquesMakeTheMotion) {
  const UrsulaRun run = simulate(torquesTimes(1));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const CsvTable motion = parseCsv(run.out, "stdout");
  ASSERT_EQ(motion.rows(), 61u);
  const CsvTable commanded = parseCsv(ursula_("inverse " + helix + " --samples 61").out, "stdout");
  for (const char* axis : {"p_x_m", "p_y_m", "p_z_m"})
    EXPECT_NEAR(motion.at(axis).back(), commanded.at(axis).back(), 1e-4);  // error of the spline through 61 rows
}

TEST_P(Simulate, aFileThatEndsBeforeTheMotionIsSaidSo) {
  const UrsulaRun run = simulate(torquesTimes(1, 1.5));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("to 1.5 s of a motion from 0 to 3 s"));
  EXPECT_EQ(parseCsv(run.out, "stdout").at("t_s").back(), 1.5) << "what was reached is kept";
}

/// Torques larger by a third lift the platform until a leg is stretched. There both engines stop.
TEST_P(Simulate, aMotionThatLeavesWhatTheLegsReachStopsThere) {
  const UrsulaRun run = simulate(torquesTimes(1.3));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("reach"));
  EXPECT_THAT(run.err, HasSubstr("leg 5"));
  EXPECT_THAT(run.err, HasSubstr("stretched"));
  const CsvTable motion = parseCsv(run.out, "stdout");
  EXPECT_GT(motion.at("t_s").back(), 1);
  EXPECT_LT(motion.at("t_s").back(), 1.3);
}

TEST_P(Simulate, theRightEffortsMakeTheMotionOfLegsOfEveryKind) {
  for (const std::string kind : {"UPS", "RUS", "PUS"}) {
    const std::string machine = testing::TempDir() + "/simulate_" + GetParam() + "_" + kind + ".toml";
    std::remove(machine.c_str());
    ursula_.passing("init '" + machine + "' --kind " + kind);
    const std::string all = ursula_("inverse '" + machine + "' --samples 301").out;
    std::ofstream(file_) << all;  // with columns that simulate ignores
    const UrsulaRun run = ursula_("simulate '" + machine + "' --engine " + GetParam() + " --torques '" + file_ + "'");
    EXPECT_EQ(run.exit_code, 0) << kind << run.err;
    const CsvTable motion = parseCsv(run.out, "stdout"), commanded = parseCsv(all, "stdout");
    ASSERT_EQ(motion.rows(), 301u) << kind;
    for (const char* axis : {"p_x_m", "p_y_m", "p_z_m"})
      EXPECT_NEAR(motion.at(axis).back(), commanded.at(axis).back(), 1e-3) << kind;  // error of the spline, amplified
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, Simulate, testing::Values("noc", "simbody"),
                         [](const auto& engine) { return engine.param; });

}  // namespace
}  // namespace ursula
