#include <gtest/gtest.h>

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
