// The reader of foreign torques: accepted files, refusals with their places, and the precision of printed numbers.

#include "validation/subject/torque_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "base/csv.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

const std::string header = "t_s,tau_1_Nm,tau_2_Nm,tau_3_Nm,tau_4_Nm,tau_5_Nm,tau_6_Nm\n";

TorqueFile parsed(const std::string& rows) { return parseTorqueFile(header + rows, "a.csv"); }

TEST(TorqueFile, readsColumnsInAnyOrderAndNamesTheOthers) {
  const TorqueFile file = parseTorqueFile(
      "tau_6_Nm,note,tau_2_Nm,t_s,tau_1_Nm,tau_3_Nm,tau_5_Nm,tau_4_Nm,p_x_m\n6,start,2,0,1,3,5,4,nan\n", "a.csv");
  EXPECT_THAT(file.t, ElementsAre(0));
  EXPECT_EQ(file.torques.at(0), (Vector6d() << 1, 2, 3, 4, 5, 6).finished());
  EXPECT_THAT(file.ignored, ElementsAre("note", "p_x_m"));
}

struct Refusal {
  const char* name;
  std::string rows, message;
};

class RefusedTorques : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedTorques, namesTheLine) {
  EXPECT_EQ(refusal<CsvError>([] { within(parsed(GetParam().rows), 3); }), "a.csv:" + GetParam().message);
}

const std::string row_0 = "0,1,1,1,1,1,1\n", row_1 = "1,1,1,1,1,1,1\n", row_2 = "2,1,1,1,1,1,1\n";

INSTANTIATE_TEST_SUITE_P(
    All, RefusedTorques,
    testing::Values(Refusal{"repeated", row_0 + row_1 + row_1,
                            "4: error: t_s = 1 repeats line 3, expected increasing instants"},
                    Refusal{"unsorted", row_0 + row_2 + row_1,
                            "4: error: t_s = 1 comes after 2 of line 3, expected increasing instants"},
                    Refusal{"close", row_0 + "1e-200,1,1,1,1,1,1\n",
                            "3: error: t_s = 1e-200 is 1e-200 s after line 2, expected at least 1e-70 s"},
                    Refusal{"no_instant", row_0 + ",1,1,1,1,1,1\n",
                            "3: error: an empty cell in column 't_s', expected a finite number"},
                    Refusal{"nan_instant", row_0 + "nan,1,1,1,1,1,1\n",
                            "3: error: 'nan' in column 't_s', expected a finite number"},
                    Refusal{"infinite_torque", row_0 + "1,1,1,1,inf,1,1\n",
                            "3: error: 'inf' in column 'tau_4_Nm', expected a finite number"},
                    Refusal{"no_torque", row_0 + "1,1,1,1,1,1,\n",
                            "3: error: an empty cell in column 'tau_6_Nm', expected a finite number"},
                    Refusal{"short_row", row_0 + "1,1,1,1,1,1\n",
                            "3: error: 6 cells, expected 7, one for each column of the header"},
                    Refusal{"no_row", "", "1: error: no rows, expected at least one below the header"},
                    Refusal{"before_start", "-0.1,1,1,1,1,1,1\n" + row_1,
                            "2: error: t_s = -0.1 lies outside of the motion, expected 0 to 3 s"},
                    Refusal{"after_end", row_0 + "3.001,1,1,1,1,1,1\n",
                            "3: error: t_s = 3.001 lies outside of the motion, expected 0 to 3 s"}),
    [](const auto& test) { return test.param.name; });

TEST(TorqueFile, asksForTheTimeAndForATransposedTable) {
  EXPECT_THAT(refusal<CsvError>([] { parseTorqueFile("1,2,3,4,5,6\n1,2,3,4,5,6\n", "a.csv"); }),
              testing::HasSubstr("; is the column of the time missing?"));
  std::string transposed = "t_s";
  for (int i = 0; i < 20; ++i) transposed += fmt::format(",0.{:02}", i);
  EXPECT_THAT(refusal<CsvError>([&] { parseTorqueFile(transposed + "\n", "a.csv"); }),
              testing::HasSubstr("; is the table transposed? expected a row per instant"));
}

TEST(TorqueFile, refusesAMissingColumn) {
  EXPECT_EQ(refusal<CsvError>([] { parseTorqueFile("t_s,tau_1_Nm\n0,1\n", "a.csv"); })
                .find("a.csv:1: error: missing column 'tau_2_Nm', expected it in the header; its columns, separated by "
                      "',', are: t_s, tau_1_Nm"),
            0U);
}

TEST(TorqueFile, takesInstantsBeyondTheEndsByRoundingAlone) {
  const TorqueFile file = within(parsed("0,1,1,1,1,1,1\n0.333333,1,1,1,1,1,1\n0.666667,1,1,1,1,1,1\n"), 2.0 / 3);
  EXPECT_EQ(file.t.back(), 2.0 / 3);
  EXPECT_THROW(within(parsed("0,1,1,1,1,1,1\n0.333333,1,1,1,1,1,1\n0.666669,1,1,1,1,1,1\n"), 2.0 / 3), CsvError);
  EXPECT_THROW(within(parsed("0,1,1,1,1,1,1\n0.7,1.25,1.25,1,1,1,1\n"), 2.0 / 3), CsvError);
}

TEST(TorqueFile, seventeenDigitsAddNothingHoweverManyZerosAreDropped) {
  const TorqueFile file = parsed("0.5,1781.1709921149679,0,100.5,-1416.5553895461321,24593.499943682222,8\n");
  EXPECT_LT(file.torque_precision[0].maxCoeff(), 1e-12);
  EXPECT_EQ(file.digits, 17);
}

TEST(TorqueFile, countsHalfAUnitOfTheLastDigit) {
  const TorqueFile fixed = parsed("0,1781.171,0.010,24593.500,-1.000,2.5,3.125\n");  // "%.3f", one zero dropped
  EXPECT_EQ(fixed.torque_precision[0], (Vector6d() << 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4).finished());
  const TorqueFile digits = parsed("0,1781.17,0.0123457,24593.5,-1.5,1e+05,0\n");  // "%.6g"
  EXPECT_TRUE(digits.torque_precision[0].isApprox((Vector6d() << 5e-3, 5e-8, 0.05, 5e-6, 0.5, 5e-8).finished(), 1e-9))
      << digits.torque_precision[0].transpose();
}

TEST(TorqueFile, instantsOfAGridAreExactAndThoseOfARoundedOneAreNot) {
  const std::string torques = ",1781.1709921149679,1,1,1,1,1\n";
  const auto precision = [&](const std::vector<std::string>& instants) {
    std::string rows;
    for (const std::string& t : instants) rows += t + torques;
    return parsed(rows).time_precision;
  };
  EXPECT_THAT(precision({"0", "0.01", "0.02", "0.03"}), ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(precision({"0", "0.333", "0.667", "1"}), ElementsAre(5e-4, 5e-4, 5e-4, 5e-4));
  // These are neither, so they are as precise as the torques beside them.
  for (double value : precision({"0.1", "0.25", "0.7"})) EXPECT_LT(value, 1e-12);
}

TEST(TorqueFile, knowsSinglePrecision) {
  EXPECT_TRUE(parsed("0,0.5,24593.5,3,0.10000000149011612,1,1\n").all_single);
  EXPECT_FALSE(parsed("0,0.5,24593.5,3,0.10000000000000001,1,1\n").all_single);
}

/// Printed with nine digits, or with as few as tell a float from its neighbours; numbers of few digits tell nothing.
TEST(TorqueFile, knowsSinglePrecisionAsPrinted) {
  const auto isSingle = [](const std::function<std::string(double)>& text) {
    std::string rows;
    for (int k = 0; k < 30; ++k) {
      rows += fmt::format("{}", k);
      for (int i = 0; i < 6; ++i) rows += "," + text(1e3 * std::sin(1 + k + 0.1 * i));
      rows += "\n";
    }
    return parsed(rows).all_single;
  };
  EXPECT_TRUE(isSingle([](double tau) { return fmt::format("{:.9g}", static_cast<float>(tau)); }));
  EXPECT_TRUE(isSingle([](double tau) { return fmt::format("{}", static_cast<float>(tau)); }));
  EXPECT_FALSE(isSingle([](double tau) { return fmt::format("{:.9g}", tau); }));
  EXPECT_FALSE(isSingle([](double tau) { return fmt::format("{}", tau); }));
  EXPECT_FALSE(isSingle([](double tau) { return fmt::format("{:.6g}", static_cast<float>(tau)); }));
}

}  // namespace
}  // namespace ursula
