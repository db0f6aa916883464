// ursula direct, as a user calls it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/csv.h"
#include "tests/end_to_end/program.h"

namespace ursula {
namespace {

std::vector<std::string> columnsOfDirect() {
  std::vector<std::string> names = {"pose", "p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"};
  names.insert(names.end(), {"multiplicity", "assembles", "residual_m"});
  for (const std::string quantity : {"reach_#", "side_#", "distance_#_m", "psi_#_rad", "theta_#_rad"})
    for (const char leg : std::string("123456")) {
      names.push_back(quantity);
      std::replace(names.back().begin(), names.back().end(), '#', leg);
    }
  return names;
}

CsvTable table(const std::string& text) {
  CsvOptions options;
  options.finite = false;
  return parseCsv(text, "direct.csv", options);
}

/// Returns φ of a row of `ursula inverse` in the form of --phi.
std::string anglesOf(const CsvTable& inverse, std::size_t row) {
  std::string text;
  for (const char leg : std::string("123456")) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", inverse.at(std::string("phi_") + leg + "_rad")[row]);
    text += (text.empty() ? "" : ",") + std::string(digits);
  }
  return text;
}

class DirectVerb : public testing::Test {
 protected:
  auto direct(const std::string& phi, const std::string& more = "") {
    return ursula_("direct " + helix + " --phi '" + phi + "' " + more);
  }

  Program ursula_;
};

TEST_F(DirectVerb, FindsTheHelixAgainFromItsAngles) {
  const CsvTable inverse = table(ursula_("inverse " + helix + " --samples 4").out);
  ASSERT_EQ(inverse.rows(), 4U);
  for (std::size_t row = 0; row < inverse.rows(); ++row) {
    const auto run = direct(anglesOf(inverse, row));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const CsvTable poses = table(run.out);
    EXPECT_EQ(poses.names, columnsOfDirect());
    double nearest = INFINITY;
    for (std::size_t pose = 0; pose < poses.rows(); ++pose) {
      double off = 0;
      for (const std::string name : {"p_x_m", "p_y_m", "p_z_m"})
        off = std::max(off, std::abs(poses.at(name)[pose] - inverse.at(name)[row]));
      nearest = std::min(nearest, off);
      EXPECT_EQ(poses.at("pose")[pose], static_cast<double>(pose + 1));
    }
    EXPECT_LE(nearest, 1e-12);  // B's condition number is below 100 along the helix; eps times that is 2e-14
    EXPECT_EQ(poses.at("assembles")[0], 1);
  }
}

TEST_F(DirectVerb, ListsPosesOutOfReach) {
  const CsvTable inverse = table(ursula_("inverse " + helix + " --samples 2").out);
  const auto run = direct(anglesOf(inverse, 0));
  const CsvTable poses = table(run.out);
  int far = 0;
  for (std::size_t pose = 0; pose < poses.rows(); ++pose) {
    bool all = true;
    for (const std::string leg : {"1", "2", "3", "4", "5", "6"}) {
      const bool reach = poses.at("reach_" + leg)[pose] == 1;
      EXPECT_EQ(std::isnan(poses.at("theta_" + leg + "_rad")[pose]), !reach);
      all = all && reach;
    }
    EXPECT_EQ(poses.at("assembles")[pose] == 1, all);
    far += all ? 0 : 1;
  }
  EXPECT_GT(far, 0);
  EXPECT_NE(run.err.find("out of reach"), std::string::npos) << run.err;
  const auto real = static_cast<int>(poses.rows());
  const std::string counts = "8 solutions: " + std::to_string(real) + " real pose" + (real == 1 ? "" : "s") + ", " +
                             std::to_string(8 - real) + " complex\n";
  EXPECT_EQ(run.err.substr(0, counts.size()), counts) << "they add up";
}

TEST_F(DirectVerb, WritesTheSameToAFile) {
  const std::string phi = "-0.48,0.50,-0.97,0.87,-0.63,0.69";
  const auto run = direct(phi, "--out poses.csv");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(ursula_.read("poses.csv"), direct(phi).out);
}

TEST_F(DirectVerb, SaysWhatIsWrong) {
  const std::string phi = "direct " + helix + " --out poses.csv --phi ";
  expectRefused(ursula_, {{phi + "1,2,3,4,5", "5 numbers, expected six"},
                          {phi + "1,2,3,4,5,6,7", "7 numbers, expected six"},
                          {phi + "1,2,three,4,5,6", "phi_3 is 'three'"},
                          {phi + "1,2,3,4,5,", "phi_6 is ''"},
                          {phi + "1,2,3,4,5,6rad", "phi_6 is '6rad'"},
                          {phi + "nan,2,3,4,5,6", "phi_1 is 'nan'"},
                          {"direct '" URSULA_SCENARIOS "/mixture.toml' --coordinates 1,2,3,4,5,6 --out poses.csv",
                           "expected six URS legs driven by phi, or six UPS, RUS or PUS legs"},
                          {"direct " + helix + " --d 1,2,3,4,5,6",
                           "has six URS legs driven by phi, expected --phi phi_1,...,phi_6"}});
}

TEST_F(DirectVerb, TellsNoPoseFromNoDeterminedPose) {
  const auto none = direct("-0.1,0.2,0.3,0.1,0.2,-0.4");
  EXPECT_EQ(none.exit_code, 0) << "none is all there are";
  EXPECT_EQ(std::count(none.out.begin(), none.out.end(), '\n'), 1) << "the header alone";
  const auto free = direct("0,0,0,0,0,0");  // with all planes upright the platform may rise and fall
  EXPECT_EQ(free.exit_code, 3);
  EXPECT_EQ(free.out, "");
  EXPECT_NE(free.err.find("free to move along a line"), std::string::npos) << free.err;
}

TEST_F(DirectVerb, FindsThePoseAgainForLegsOfCrankAndRod) {
  ursula_.passing("init rus.toml --kind RUS");
  const CsvTable inverse = table(ursula_("inverse rus.toml --samples 3").out);
  for (const std::string option : {"--phi", "--coordinates"}) {
    const UrsulaRun run = ursula_.passing("direct rus.toml " + option + " '" + anglesOf(inverse, 1) + "'");
    const CsvTable poses = table(run.out);
    double nearest = 1;
    for (std::size_t k = 0; k < poses.rows(); ++k)
      if (const double apart =
              std::hypot(poses.at("p_x_m")[k] - inverse.at("p_x_m")[1], poses.at("p_y_m")[k] - inverse.at("p_y_m")[1],
                         poses.at("p_z_m")[k] - inverse.at("p_z_m")[1]);
          poses.at("side_1")[k] == 1 && poses.at("side_6")[k] == 1)
        nearest = std::min(nearest, apart);
    EXPECT_LT(nearest, 1e-9);
  }
}

}  // namespace
}  // namespace ursula
