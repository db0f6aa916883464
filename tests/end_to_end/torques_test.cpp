// `ursula validate --torques`, as a user calls it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "tests/end_to_end/program.h"
#include "tests/model/scenario_text.h"

namespace ursula {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Makes a scenario and its results of `ursula inverse`.
void prepare(const Program& ursula, const std::string& samples) {
  ursula.write("small.toml", good_scenario);
  ASSERT_EQ(ursula("inverse small.toml --samples " + samples + " --out tau.csv").exit_code, 0);
}

std::string replacedLine(const std::string& text, int line, const std::function<std::string(std::string)>& change) {
  std::stringstream in(text);
  std::string out, row;
  for (int k = 1; std::getline(in, row); ++k) out += (k == line ? change(row) : row) + "\n";
  return out;
}

TEST(TorquesRun, whatInverseWritesPasses) {
  const Program ursula;
  prepare(ursula, "101");
  const auto run = ursula("validate small.toml --torques tau.csv --out out");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(ursula("compare out out --tolerance 0").exit_code, 0) << "two folders of results";
  EXPECT_EQ(ursula("compare out tau.csv").exit_code, 3) << "only a part of the channels is common, and all agree";
  EXPECT_THAT(run.out,
              AllOf(StartsWith("small: pass\n"), HasSubstr("torque.against_noc"), HasSubstr("replay.position")));
  EXPECT_THAT(run.err,
              AllOf(StartsWith("tau.csv: columns other than t_s"), HasSubstr("p_x_m"), Not(HasSubstr("tau_1_Nm, "))));
  EXPECT_TRUE(std::filesystem::exists(ursula.folder() / "out/summary.json"));
}

TEST(TorquesRun, wrongOnesFailAndSayWhy) {
  const Program ursula;
  prepare(ursula, "101");
  std::string text = TemporaryFolder::read(ursula.folder() / "tau.csv");
  text = replaced(text, "tau_2_Nm", "tau_x_Nm");
  text = replaced(text, "tau_5_Nm", "tau_2_Nm");
  ursula.write("tau.csv", replaced(text, "tau_x_Nm", "tau_5_Nm"));
  const auto run = ursula("validate small.toml --torques tau.csv --out out");
  EXPECT_EQ(run.exit_code, 1) << run.out;
  const std::string summary = TemporaryFolder::read(ursula.folder() / "out/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"likely cause\": \"legs 2 and 5 swapped, which explains"));
}

TEST(TorquesRun, fewOnesAreInconclusive) {
  const Program ursula;
  prepare(ursula, "5");
  EXPECT_EQ(ursula("validate small.toml --torques tau.csv --out out").exit_code, 3);
}

TEST(TorquesRun, refusalsNameTheLineAndWriteNothing) {
  const Program ursula;
  prepare(ursula, "5");
  const std::string text = TemporaryFolder::read(ursula.folder() / "tau.csv");
  const auto refused = [&](const std::string& faulty) {
    ursula.write("bad.csv", faulty);
    const auto run = ursula("validate small.toml --torques bad.csv --out out");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(std::filesystem::exists(ursula.folder() / "out"));
    return run.err;
  };
  const auto repeated = [&](const std::string& row) { return row + "\n" + row; };
  EXPECT_THAT(refused(replacedLine(text, 3, repeated)), HasSubstr("bad.csv:4: error: t_s = 0.75 repeats line 3"));
  const auto without = [](const std::string& row) { return row.substr(row.find(',')); };
  EXPECT_THAT(refused(replacedLine(text, 4, without)), HasSubstr("bad.csv:4: error: an empty cell in column 't_s'"));
  const auto late = [&](const std::string& row) { return "3.5" + row.substr(row.find(',')); };
  EXPECT_THAT(refused(replacedLine(text, 6, late)),
              HasSubstr("bad.csv:6: error: t_s = 3.5 lies outside of the motion, expected 0 to 3 s"));
  EXPECT_THAT(refused(replaced(text, "tau_4_Nm", "fourth")), HasSubstr("bad.csv:1: error: missing column 'tau_4_Nm'"));
}

}  // namespace
}  // namespace ursula
