// What CI reads: annotations of GitHub, SARIF, what changed since an earlier run, and efforts that lie beside
// scenarios.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "tests/end_to_end/program.h"

namespace ursula {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A four-bar with its efforts times a factor, in a file beside it.
class CiFindings : public testing::Test {
 protected:
  CiFindings() {
    std::filesystem::create_directories(ursula_.folder() / "suite");
    for (const std::string file : {"fourbar.toml", "fourbar.xml"})
      ursula_.write("suite/" + file, TemporaryFolder::read(std::string(URSULA_VECTORS "/loops/") + file));
    ursula_.passing("inverse suite/fourbar.toml --samples 51 --out motion.csv");
  }
  void writeEfforts(const std::string& file, double factor) const {
    const CsvTable motion = readCsv(ursula_.folder() / "motion.csv");
    std::vector<double> efforts = motion.at("tau_1_Nm");
    for (double& each : efforts) each *= factor;
    ursula_.write(file, csvText({"t_s", "tau_1_Nm"}, {motion.at("t_s"), efforts}));
  }
  const Program ursula_;
};

TEST_F(CiFindings, areAnnotationsOfGitHub) {
  writeEfforts("wrong.csv", 1.01);
  const UrsulaRun wrong = ursula_.ending(1, "validate suite/fourbar.toml --torques wrong.csv --format github --out o");
  EXPECT_THAT(wrong.out, StartsWith("::error file=suite/fourbar.toml,line=1,col=1,title=ursula%3A fail::fourbar: "));
  EXPECT_THAT(wrong.out, HasSubstr("1 %25"));
  EXPECT_THAT(wrong.out, HasSubstr("; likely cause: "));
  EXPECT_EQ(std::count(wrong.out.begin(), wrong.out.end(), '\n'), 1) << "one line for a scenario";
  const UrsulaRun right = ursula_.passing("validate suite/fourbar.toml --format github --out o");
  EXPECT_THAT(right.out, StartsWith("::notice file=suite/fourbar.toml"));
  EXPECT_THAT(right.out, Not(HasSubstr("likely cause")));
}

TEST_F(CiFindings, areSarif) {
  writeEfforts("wrong.csv", 1.01);
  const auto run = ursula_("validate suite/fourbar.toml --torques wrong.csv --format sarif --out o");
  const nlohmann::json log = nlohmann::json::parse(run.out);
  EXPECT_EQ(log["version"], "2.1.0");
  const auto& results = log["runs"][0]["results"];
  ASSERT_FALSE(results.empty());
  EXPECT_EQ(results[0]["level"], "error");
  EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "suite/fourbar.toml");
  const auto passed = ursula_("validate suite/fourbar.toml --format sarif --out o");
  EXPECT_TRUE(nlohmann::json::parse(passed.out)["runs"][0]["results"].empty());
}

TEST_F(CiFindings, placeBadScenarios) {
  ursula_.write("suite/bad.toml", "name = \"bad\"\n[mechanism]\nfile = 7\n");
  const UrsulaRun run = ursula_.ending(1, "validate suite --format github --out o");
  EXPECT_THAT(run.out, HasSubstr("::error file=suite/bad.toml,line=3,col="));
  EXPECT_THAT(run.out, HasSubstr("::notice file=suite/fourbar.toml"));
}

TEST_F(CiFindings, placeRefusedInput) {
  ursula_.write("bad.toml", "name = \"bad\"\n[mechanism]\nfile = 7\n");
  writeEfforts("none.csv", 1);
  ursula_.write("none.csv", "t_s,tau_1_Nm\n0,1\nx,2\n");
  for (const auto& [call, place] : {std::pair<std::string, std::string>{"bad.toml", "bad.toml,line=3,"},
                                    {"suite/fourbar.toml --torques none.csv", "none.csv,line=3,"},
                                    {"suite/fourbar.toml --map nobody=t", "suite/fourbar.toml,line=1,"},
                                    {"suite/fourbar.toml bad.toml --strict", "bad.toml,line=3,"}}) {
    const UrsulaRun run = ursula_.ending(2, "validate " + call + " --format github --out o");
    EXPECT_THAT(run.out, StartsWith("::error file=" + place)) << call;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << call;
    EXPECT_NE(run.err, "") << call;
    EXPECT_EQ(ursula_("validate " + call + " --out o").out, "") << call;
  }
  const auto sarif = ursula_("validate bad.toml --format sarif --out o");
  EXPECT_EQ(nlohmann::json::parse(sarif.out)["runs"][0]["results"].size(), 1);
}

TEST_F(CiFindings, sayWhatChangedSinceAnEarlierRun) {
  writeEfforts("wrong.csv", 1.01);
  ursula_.passing("validate suite/fourbar.toml --out old --quiet");
  const auto same = ursula_("validate suite/fourbar.toml --out new --against old --quiet");
  EXPECT_THAT(same.out, HasSubstr("fourbar, since old:\n  nothing changed\n"));
  const UrsulaRun run =
      ursula_.ending(1, "validate suite/fourbar.toml --torques wrong.csv --out new --against old --quiet");
  EXPECT_THAT(run.out, HasSubstr("  verdict: pass before, fail now\n"));
  EXPECT_THAT(run.out, HasSubstr("  torque.pointwise: pass before, fail now\n"));
  const UrsulaRun nowhere = ursula_.ending(2, "validate suite/fourbar.toml --out other --against nowhere --quiet");
  EXPECT_THAT(nowhere.err, HasSubstr("--against nowhere: no such folder"));
  EXPECT_FALSE(std::filesystem::exists(ursula_.folder() / "other"));
  std::filesystem::create_directory(ursula_.folder() / "empty");
  const auto none = ursula_("validate suite/fourbar.toml --out new --against empty --quiet");
  EXPECT_THAT(none.out, HasSubstr("no earlier summary.json to compare with"));
}

TEST_F(CiFindings, judgeEffortsBesideAScenario) {
  writeEfforts("suite/fourbar.csv", 1);
  ursula_.passing("validate suite --out o --quiet");
  writeEfforts("suite/fourbar.csv", 1.01);
  const UrsulaRun wrong = ursula_.ending(1, "validate suite --out o --quiet");
  EXPECT_THAT(wrong.out, HasSubstr("torque.against_noc"));
  const auto alone = ursula_("validate suite/fourbar.toml --out o --quiet");
  EXPECT_EQ(alone.exit_code, 0) << "a file that is named alone is judged alone";
}

}  // namespace
}  // namespace ursula
