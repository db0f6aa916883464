#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/csv.h"
#include "parts/identify/log_grid.h"
#include "parts/identify/measured_log.h"
#include "tests/studies/identify/synthetic_log.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

class MeasuredLogs : public testing::Test {
 protected:
  Scenario scenario = readScenario(std::string(URSULA_SCENARIOS) + "/paper-helix.toml");

  MeasuredLog read(const std::string& text, const std::vector<std::string>& map = {},
                   const std::vector<double>& constants = {}) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "log.csv";
    std::ofstream(file) << text;
    return readMeasuredLog({file, map, constants}, *scenario.manipulator);
  }

  std::string refusal(const std::string& text, const std::vector<std::string>& map = {}) {
    try {
      read(text, map);
    } catch (const CsvError& error) {
      return error.what();
    }
    return "";
  }

  /// Twenty rows; coordinate k is k + 0.1 t, effort k is 10 k + t.
  static std::string rows(const std::string& header, const char* between, double time_unit = 1, int without = -1,
                          int count = 1) {
    std::string out = header + "\n";
    for (int i = 0; i < 20; ++i) {
      if (i >= without && i < without + count) continue;
      const double t = 0.01 * i;
      out += std::to_string(t * time_unit);
      for (int k = 1; k <= 6; ++k) out += between + std::to_string(k + 0.1 * t);
      for (int k = 1; k <= 6; ++k) out += between + std::to_string(10 * k + t);
      out += "\n";
    }
    return out;
  }
  static std::string own() {
    return "t_s,phi_1_rad,phi_2_rad,phi_3_rad,phi_4_rad,phi_5_rad,phi_6_rad,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_"
           "Nm,tau_6_Nm";
  }
};

void expectRows(const MeasuredLog& log) {
  ASSERT_EQ(log.rows(), 20);
  EXPECT_NEAR(log.step, 0.01, 1e-9);
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(log.motion(10, k), k + 1 + 0.01, 1e-5);
    EXPECT_NEAR(log.efforts(10, k), 10 * (k + 1) + 0.1, 1e-5);
  }
}

TEST_F(MeasuredLogs, areReadInManyDialects) {
  expectRows(read(rows(own(), ",")));
  expectRows(read(rows("Time [ms];q1;q2;q3;q4;q5;q6;tau1;tau2;tau3;tau4;tau5;tau6", ";", 1000)));
  expectRows(read(rows("# t phi_1 phi_2 phi_3 phi_4 phi_5 phi_6 tau1 tau2 tau3 tau4 tau5 tau6", " ")));
  expectRows(read(rows("t,enc0,enc1,enc2,enc3,enc4,enc5,tau0,tau1,tau2,tau3,tau4,tau5", ",")));
  expectRows(read(rows("t_s,a,phi_2_rad,phi_3_rad,phi_4_rad,phi_5_rad,phi_6_rad,tau1,tau2,tau3,tau4,tau5,b", ","),
                  {"phi_1_rad=a", "tau_6_Nm=b"}));
}

TEST_F(MeasuredLogs, currentsNeedTheirConstants) {
  const std::string text = rows("t_s,q1,q2,q3,q4,q5,q6,i1,i2,i3,i4,i5,i6", ",");
  const MeasuredLog log = read(text, {}, {2});
  EXPECT_NEAR(log.efforts(10, 0), 2 * 10.1, 1e-5);
  EXPECT_THAT(refusal(text), HasSubstr("--constant"));
}

TEST_F(MeasuredLogs, degreesAreRadiansByTheirName) {
  const MeasuredLog log =
      read(rows("t_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,tau1,tau2,tau3,tau4,tau5,tau6", ","));
  EXPECT_NEAR(log.motion(0, 0), std::acos(-1.0) / 180, 1e-9);
}

/// Returns what a grid makes of rows whose value is their index.
MeasuredLog gridOf(std::size_t rows, double step) {
  identification::LogGrid grid(1, {});
  std::vector<double> row(1);
  for (std::size_t i = 0; i < rows; ++i) {
    row[0] = static_cast<double>(i);
    grid.add(static_cast<double>(i) * step, row, [] { return std::string("a row"); });
  }
  return grid.finish("long.csv");
}

TEST(LogGrid, takesEverySecondRowOfALongLogAndTheFirstOfALongCoarseOne) {
  const std::size_t most = most_log_rows;
  const MeasuredLog fine = gridOf(most + 1001, 0.002);
  EXPECT_EQ(fine.every, 2);
  EXPECT_NEAR(fine.step, 0.004, 1e-12);
  EXPECT_TRUE(fine.findings.empty());
  ASSERT_EQ(fine.motion.rows(), static_cast<Eigen::Index>(most / 2 + 501));
  for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(7), Eigen::Index(most / 2 + 500)})
    EXPECT_EQ(fine.motion(i, 0), 2 * static_cast<double>(i));
  const MeasuredLog coarse = gridOf(most + 1001, 0.006);
  EXPECT_EQ(coarse.every, 1);
  EXPECT_EQ(coarse.motion.rows(), static_cast<Eigen::Index>(most));
  ASSERT_EQ(coarse.findings.size(), 1U);
  EXPECT_EQ(coarse.findings[0].kind, "long");
  EXPECT_EQ(coarse.findings[0].value, 1001);
}

TEST_F(MeasuredLogs, shortGapsAreFilledAndLongOnesMarked) {
  const MeasuredLog log = read(rows(own(), ",", 1, 7));
  expectRows(log);
  EXPECT_FALSE(log.missing[7]);
  EXPECT_TRUE(log.filled.at(7));
  EXPECT_FALSE(log.filled[6]);
  EXPECT_NEAR(log.motion(7, 0), 1 + 0.1 * 0.07, 1e-5);
  ASSERT_EQ(log.findings.size(), 1U);
  EXPECT_EQ(log.findings[0].kind, "drop_outs");
  EXPECT_EQ(log.findings[0].value, 1);
  const MeasuredLog longer = read(rows(own(), ",", 1, 7, 4));
  EXPECT_EQ(std::count(longer.missing.begin(), longer.missing.end(), true), 4);
  EXPECT_TRUE(longer.missing[7]);
  EXPECT_TRUE(longer.filled.empty());
}

/// A value that stays where its cell is empty would be a step, and steps look like a fast motion.
TEST_F(MeasuredLogs, rowsWithEmptyCellsAreMissingRows) {
  std::string text = rows(own(), ",");
  for (const char* row : {"0.070000,1.007000", "0.080000,1.008000", "0.090000,1.009000", "0.100000,1.010000"})
    text.replace(text.find(row), 17, std::string(row, 9));
  const MeasuredLog log = read(text);
  expectRows(log);
  EXPECT_TRUE(log.missing[7]);
  EXPECT_FALSE(log.missing[11]);
  EXPECT_NEAR(log.motion(7, 0), 1.007, 1e-5);
  ASSERT_EQ(log.findings.size(), 1U);
  EXPECT_EQ(log.findings[0].kind, "drop_outs");
  EXPECT_EQ(log.findings[0].value, 4);
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST_F(MeasuredLogs, aColumnTwiceIsRefusedUnlessOneIsNamed) {
  EXPECT_THAT(refusal(rows(with(own(), "tau_2_Nm", "tau_1_Nm"), ",")),
              testing::AllOf(HasSubstr("log.csv:1"), HasSubstr("duplicate column 'tau_1_Nm'")));
  const std::string text = rows("t_s,q1,q2,q3,q4,q5,enc1,tau1,tau2,tau3,tau4,tau5,tau6", ",");
  EXPECT_THAT(refusal(text), HasSubstr("missing column 'phi_6_rad'"));
  std::string more = "t_s,q1,q2,q3,q4,q5,q6,tau1,tau2,tau3,tau4,tau5,tau6,enc1\n";
  for (int i = 0; i < 20; ++i) more += std::to_string(0.01 * i) + ",1,2,3,4,5,6,1,2,3,4,5,6,9\n";
  EXPECT_THAT(refusal(more), testing::AllOf(HasSubstr("'q1'"), HasSubstr("'enc1'"), HasSubstr("--map")));
  EXPECT_EQ(read(more, {"phi_1_rad=enc1"}).motion(0, 0), 9);
  EXPECT_EQ(read(with(more, "q1", "phi_1_rad")).motion(0, 0), 1) << "the contract's name is certain";
}

TEST_F(MeasuredLogs, aRowOfAnotherWidthIsRefusedWithItsLine) {
  const std::string good = rows(own() + ",note", ",");
  const auto each = [](std::string text, const std::string& end) {
    for (auto at = text.find('\n', text.find('\n') + 1); at != std::string::npos;
         at = text.find('\n', at + end.size() + 1))
      text.insert(at, end);
    return text;
  };
  expectRows(read(each(good, ",0")));
  EXPECT_THAT(refusal(good), HasSubstr("log.csv:2: error: 13 cells, expected 14"));
  EXPECT_THAT(refusal(each(good, ",0,0")), HasSubstr("log.csv:2: error: 15 cells, expected 14"));
}

TEST_F(MeasuredLogs, aLoadIsWholeAndEachOfItsGapsIsSaid) {
  const auto loaded = [](const std::string& names, const std::string& cells) {
    std::string text = rows(own(), ",");
    text.insert(text.find('\n'), names);
    for (auto at = text.find('\n', text.find('\n') + 1); at != std::string::npos;
         at = text.find('\n', at + cells.size() + 2))
      text.insert(at, cells);
    return text;
  };
  EXPECT_THAT(refusal(loaded(",f_x_N", ",1")), HasSubstr("missing column 'f_y_N'"));
  EXPECT_THAT(refusal(loaded(",f_x_N,f_y_N,f_z_N", ",1,2,3")), HasSubstr("missing column 'm_x_Nm'"));
  const std::string all = ",f_x_N,f_y_N,f_z_N,m_x_Nm,m_y_Nm,m_z_Nm";
  const MeasuredLog log = read(loaded(all, ",1,2,3,4,5,6"));
  EXPECT_EQ(log.load(3, 5), 3);
  EXPECT_TRUE(log.findings.empty());
  const MeasuredLog gap = read(with(loaded(all, ",1,2,3,4,5,6"), "1,2,3,4,5,6\n0.07", "1,nan,3,4,5,6\n0.07"));
  ASSERT_EQ(gap.findings.size(), 1U);
  EXPECT_THAT(gap.findings[0].what, HasSubstr("the first is 'f_y_N' in line 8"));
  EXPECT_THAT(refusal(loaded(all, ",1,nan,3,4,5,6")), HasSubstr("the first is 'f_y_N' in line 2"));
}

TEST_F(MeasuredLogs, latin1IsReadAsUtf8) {
  const MeasuredLog log = read(with(rows(own(), ","), "t_s", "Time [\xb5s]"), {}, {});
  EXPECT_NEAR(log.file_step, 1e-8, 1e-15);
  EXPECT_THAT(log.read_as, HasSubstr("'Time [µs]'"));
  EXPECT_EQ(read(with(rows(own(), ","), "t_s", "\xb0t"), {"t_s=\xb0t"}).file_rows, 20U)
      << "as a Latin-1 terminal gives";
}

/// Twenty rows of a pose that moves and turns, in the given columns.
TEST_F(MeasuredLogs, posesComeWithQuaternionsOrWithAngles) {
  const auto log = [](const std::string& pose, double length, double angle) {
    std::string text = "t_s," + pose + ",tau1,tau2,tau3,tau4,tau5,tau6\n";
    for (int i = 0; i < 20; ++i)
      text += fmt::format("{},{},{},{},{},{},{},1,2,3,4,5,6\n", 0.01 * i, 0.1 * length, 0.2 * length,
                          (1.4 + 0.001 * i) * length, 0.1 * angle, 0.2 * angle, 0.01 * i * angle);
    return text;
  };
  const MeasuredLog rad = read(log("p_x_m,p_y_m,p_z_m,roll_rad,pitch_rad,yaw_rad", 1, 1));
  const Eigen::Matrix3d Q =
      (Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  ASSERT_TRUE(rad.has_poses);
  const Eigen::Quaterniond q(rad.motion(10, 3), rad.motion(10, 4), rad.motion(10, 5), rad.motion(10, 6));
  EXPECT_LE((q.toRotationMatrix() - Q).norm(), 1e-15);
  const MeasuredLog deg = read(log("surge_mm,sway_mm,heave_mm,roll_deg,pitch_deg,yaw_deg", 1e3, 180 / std::acos(-1.0)));
  EXPECT_LE((deg.motion - rad.motion).norm(), 1e-13);
  EXPECT_THAT(refusal(log("p_x_m,p_y_m,p_z_m,roll,pitch,yaw", 1, 1)), HasSubstr("'q_w'")) << "in which unit?";
  EXPECT_THAT(refusal(log("p_x_m,p_y_m,p_z_m,roll_rad,pitch_rad,yaww_rad", 1, 1)),
              testing::AllOf(HasSubstr("missing column 'yaw_rad'"), HasSubstr("did you mean 'yaww_rad'?")));
}

TEST_F(MeasuredLogs, refusalsHaveTheirPlaceAndWhatIsMissing) {
  std::string text = own();
  text.replace(text.find("tau_3_Nm"), 8, "current3");
  EXPECT_THAT(refusal(rows(text, ",")),
              testing::AllOf(HasSubstr("log.csv:1"), HasSubstr("'tau_3_Nm'"), HasSubstr("--map")));
  EXPECT_THAT(refusal(own() + "\n"), HasSubstr("0 rows"));
  std::string word = rows(own(), ",");
  word.replace(word.find("0.010000"), 8, "0.01zzz0");
  EXPECT_THAT(refusal(word), testing::AllOf(HasSubstr("log.csv:3"), HasSubstr("0.01zzz0")));
  std::string back = rows(own(), ",");
  back.replace(back.find("0.020000"), 8, "0.010000");
  EXPECT_THAT(refusal(back), testing::AllOf(HasSubstr("log.csv:4"), HasSubstr("increasing")));
  EXPECT_THAT(refusal(rows(own(), ","), {"phi_9_rad=tau_1_Nm"}), HasSubstr("--map"));
}

}  // namespace
}  // namespace ursula
