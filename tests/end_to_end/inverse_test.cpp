// Compares the files of `ursula inverse` with their contract, and its numbers with tests/vectors.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "base/csv.h"
#include "base/real50.h"
#include "tests/end_to_end/program.h"
#include "tests/support/vectors.h"

namespace ursula {
namespace {

std::vector<std::string> contractColumns() {
  std::vector<std::string> out = {"t_s", "p_x_m", "p_y_m", "p_z_m", "q_w", "q_x", "q_y", "q_z"};
  const auto axes = [&out](const std::string& quantity, const std::string& unit) {
    for (const char* axis : {"x", "y", "z"}) out.push_back(quantity + "_" + axis + "_" + unit);
  };
  const auto legs = [&out](const std::string& quantity, const std::string& unit) {
    for (int i = 1; i <= 6; ++i) out.push_back(quantity + "_" + std::to_string(i) + "_" + unit);
  };
  axes("v", "m_s"), axes("w", "rad_s"), axes("a", "m_s2"), axes("alpha", "rad_s2");
  for (const char* joint : {"phi", "psi", "theta"}) legs(joint, "rad");
  for (const char* joint : {"phidot", "psidot", "thetadot"}) legs(joint, "rad_s");
  for (const char* joint : {"phiddot", "psiddot", "thetaddot"}) legs(joint, "rad_s2");
  legs("tau", "Nm");
  return out;
}

TEST(Inverse, printsTheColumnsOfTheContract) {
  const Program ursula;
  const UrsulaRun run = ursula.passing("inverse " + helix);
  EXPECT_EQ(run.err, "");
  const CsvTable table = parseCsv(run.out, "stdout");
  EXPECT_EQ(table.names, contractColumns());
  EXPECT_EQ(table.rows(), 301u);
  EXPECT_EQ(table.at("t_s").front(), 0);
  EXPECT_EQ(table.at("t_s").back(), 3);
}

/// Cells have 17 significant digits, or fewer if the number needs fewer, and nothing else.
TEST(Inverse, writesNumbersThatReadBackTheSame) {
  const Program ursula;
  std::istringstream lines(ursula("inverse --samples 2 " + helix).out);
  const std::regex number(R"(-?\d+(\.\d+)?(e[+-]\d+)?)");
  std::string line, cell;
  std::getline(lines, line);
  std::size_t cells = 0, long_ones = 0;
  while (std::getline(lines, line))
    for (std::istringstream row(line); std::getline(row, cell, ','); ++cells) {
      EXPECT_TRUE(std::regex_match(cell, number)) << cell;
      const std::string mantissa = cell.substr(0, cell.find('e'));
      const auto digits = std::count_if(mantissa.begin(), mantissa.end(), [](char c) { return c >= '0' && c <= '9'; });
      long_ones += digits >= 17;
    }
  EXPECT_EQ(cells, 2 * contractColumns().size());
  EXPECT_GT(long_ones, cells / 4);
}

class InverseNumbers : public testing::TestWithParam<std::string> {};

Vector6<Real50> six(const CsvTable& table, const std::vector<std::string>& names, std::size_t row) {
  Vector6<Real50> out = Vector6<Real50>::Zero();
  for (std::size_t k = 0; k < names.size(); ++k) out(static_cast<int>(k)) = Real50(table.at(names[k])[row]);
  return out;
}

std::vector<std::string> legNames(const std::string& quantity, const std::string& unit) {
  std::vector<std::string> out;
  for (int i = 1; i <= 6; ++i) out.push_back(quantity + "_" + std::to_string(i) + "_" + unit);
  return out;
}

void expectClose(const Vector6<Real50>& found, const Vector6<Real50>& expected, const std::string& what) {
  EXPECT_LE(static_cast<double>(Real50((found - expected).norm() / expected.norm())), 1e-12) << what;
  EXPECT_GT(static_cast<double>(Real50(expected.norm())), 0) << what;
}

/// The vectors' instants are those of 21 samples: 1, 5, 9, 13, 17 twentieths of the duration.
TEST_P(InverseNumbers, areThoseOfTheVectors) {
  const Program ursula;
  const std::string folder = GetParam() == "paper-helix" ? URSULA_SCENARIOS : URSULA_VECTORS;
  const UrsulaRun run = ursula.passing("inverse --samples 21 '" + folder + "/" + GetParam() + ".toml' --out out.csv");
  EXPECT_EQ(run.out, "");
  const CsvTable table = readCsv(ursula.folder() / "out.csv");
  const std::vector<VectorRow> rows = vectorRows(GetParam());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t row = 1 + 4 * k;
    const VectorRow& expected = rows[k];
    EXPECT_NEAR(table.at("t_s")[row], static_cast<double>(expected.motion.t), 1e-15);
    const auto compare = [&](const std::vector<std::string>& names, const auto& values) {
      expectClose(six(table, names, row), values, names.front());
    };
    Vector6<Real50> motion;
    motion << expected.motion.p, expected.motion.p_dot;
    compare({"p_x_m", "p_y_m", "p_z_m", "v_x_m_s", "v_y_m_s", "v_z_m_s"}, motion);
    motion << expected.motion.omega_dot, expected.motion.p_ddot;
    compare({"alpha_x_rad_s2", "alpha_y_rad_s2", "alpha_z_rad_s2", "a_x_m_s2", "a_y_m_s2", "a_z_m_s2"}, motion);
    compare(legNames("phi", "rad"), expected.q.phi);
    compare(legNames("psi", "rad"), expected.q.psi);
    compare(legNames("theta", "rad"), expected.q.theta);
    compare(legNames("phidot", "rad_s"), expected.q_dot.phi);
    compare(legNames("psidot", "rad_s"), expected.q_dot.psi);
    compare(legNames("thetadot", "rad_s"), expected.q_dot.theta);
    compare(legNames("phiddot", "rad_s2"), expected.q_ddot.phi);
    compare(legNames("psiddot", "rad_s2"), expected.q_ddot.psi);
    compare(legNames("thetaddot", "rad_s2"), expected.q_ddot.theta);
    compare(legNames("tau", "Nm"), expected.torques);
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, InverseNumbers, testing::ValuesIn(vectorNames()),
                         [](const auto& name) { return "of_" + std::string(1, name.param.back()); });

TEST(Inverse, takesAHyphenForStandardOutput) {
  const Program ursula;
  const UrsulaRun plain = ursula("inverse --samples 3 " + helix),
                  hyphen = ursula("inverse --samples 3 --out - " + helix);
  EXPECT_EQ(hyphen.exit_code, 0);
  EXPECT_EQ(hyphen.out, plain.out);
  EXPECT_EQ(ursula.files(), 0u) << "a file of that name, perhaps";
  ursula.passing("inverse --samples 3 --out file.csv " + helix);
  EXPECT_EQ(ursula.read("file.csv"), plain.out);
}

TEST(Inverse, refusesFewerThanTwoSamples) {
  const Program ursula;
  for (const char* samples : {"1", "0", "-3", "1.5", "many", ""})
    expectRefused(ursula, {{std::string("inverse --out file.csv --samples '") + samples + "' " + helix, "--samples"}});
}

}  // namespace
}  // namespace ursula
