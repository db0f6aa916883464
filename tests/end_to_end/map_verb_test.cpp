// `ursula map`: its rows against `ursula inverse`, its picture, and impossible grids.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

CsvTable mapOf(const Program& ursula, const std::string& arguments) {
  const UrsulaRun run = ursula.passing("map " + helix + " " + arguments);
  return parseCsv(run.out, "stdout", {{}, false, {}});
}

TEST(Map, hasARowForEachPoseTheFirstAxisFastest) {
  const Program ursula;
  const CsvTable table = mapOf(ursula, "--x=-0.1,0.1,3 --yaw 0,10,2 --z 2.5");
  ASSERT_EQ(table.rows(), 6u);
  EXPECT_THAT(table.at("p_x_m"),
              testing::Pointwise(testing::DoubleNear(1e-15), std::vector<double>{-0.1, 0, 0.1, -0.1, 0, 0.1}));
  EXPECT_EQ(table.at("yaw_rad").front(), 0);
  EXPECT_NEAR(table.at("yaw_rad").back(), 0.17453292519943295, 1e-16);
  for (const double z : table.at("p_z_m")) EXPECT_EQ(z, 2.5);
}

/// The efforts of a motion at rest are those of the map.
TEST(Map, largestEffortIsThatOfAMotionAtRest) {
  const Program ursula;
  const CsvTable rest = parseCsv(ursula("inverse --samples 2 '" URSULA_SCENARIOS "/hold.toml'").out, "stdout");
  double largest = 0;
  for (int k = 1; k <= 6; ++k) largest = std::max(largest, std::abs(rest.at("tau_" + std::to_string(k) + "_Nm")[0]));
  const double x = rest.at("p_x_m")[0], y = rest.at("p_y_m")[0];
  char axes[200];
  std::snprintf(axes, sizeof(axes), "--x=%.17g,%.17g,2 --y=%.17g,%.17g,2", x, x + 0.1, y, y + 0.1);
  const UrsulaRun run = ursula(std::string("map '" URSULA_SCENARIOS "/hold.toml' ") + axes);
  const CsvTable table = parseCsv(run.out, "stdout", {{}, false, {}});
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.at("reach")[0], 1);
  EXPECT_NEAR(table.at("tau_max_Nm")[0] / largest, 1, 1e-12);
  EXPECT_GT(std::abs(table.at("tau_max_Nm")[3] / largest - 1), 1e-6) << "another pose, another effort";
  EXPECT_GT(table.at("kappa_B")[0], 1);
  double least = 1;
  for (int i = 1; i <= 6; ++i) least = std::min(least, table.at("sine_" + std::to_string(i))[0]);
  EXPECT_EQ(table.at("sine_min")[0], least);
}

TEST(Map, saysWhatIsOutOfReachAndDrawsItGrey) {
  const Program ursula;
  const CsvTable table = mapOf(ursula, "--x=-9,9,7 --y=-9,9,7 --jobs 1");
  std::size_t reached = 0;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    reached += table.at("reach")[k] == 1;
    EXPECT_EQ(std::isnan(table.at("kappa_B")[k]), table.at("reach")[k] == 0);
    EXPECT_EQ(std::isnan(table.at("tau_max_Nm")[k]), table.at("reach")[k] == 0);
  }
  EXPECT_GT(reached, 0u);
  EXPECT_LT(reached, table.rows());
  ursula.passing("map " + helix + " --x=-9,9,7 --y=-9,9,7 --picture map.svg --out map.csv --jobs 7");
  const std::string picture = ursula.read("map.svg");
  for (const char* part :
       {"<svg", "<path style=\"fill:#bbb\"", "x in m", "y in m", "κ(B)", "largest static effort, kN·m"})
    EXPECT_THAT(picture, HasSubstr(part));
  EXPECT_EQ(parseCsv(ursula.read("map.csv"), "map.csv", {{}, false, {}}).at("reach"), table.at("reach"));
}

TEST(Map, refusesGridsThatCannotBe) {
  const Program ursula;
  Refusals wrong = {
      {"--x 0,1 --y 0,1,2", "2 numbers, expected FROM,TO,COUNT or one value"},
      {"--x 0,nan,5 --y 0,1,2", "'nan' is not a finite number"},
      {"--x 0,1,0 --y 0,1,2", "a count of 0, expected a whole number of 1 or more"},
      {"--x 0,1,-3 --y 0,1,2", "a count of -3"},
      {"--x 0,1,2.5 --y 0,1,2", "a count of 2.5"},
      {"--x 1,1,5 --y 0,1,2", "expected two ends apart"},
      {"--x 0,1,5", "1 coordinate varies (x), expected two or three"},
      {"--x 0,1,2 --y 0,1,2 --z 2,3,2 --yaw 0,9,2", "4 coordinates vary (x, y, z, yaw), expected two or three"},
      {"--x 0,1,100000 --y 0,1,100000", "more than 100 million poses"},
      {"--x 0,1,2000 --y 0,1,2000 --picture p.svg", "4000000 poses, expected at most 1000000"},
      {"--x 0,1,2 --y 0,1,2 --at 9", "--at 9: expected an instant of the motion, from 0 to 3 s"}};
  for (auto& [call, says] : wrong) call.insert(0, "map " + helix + " --out map.csv ");
  expectRefused(ursula, wrong);
}

}  // namespace
}  // namespace ursula
