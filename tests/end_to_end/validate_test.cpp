// `ursula validate` from the scenario to the folder of results, by its exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/model/scenario_text.h"

namespace ursula {
namespace {

using testing::HasSubstr;

/// The paper's example with fewer instants, for speed, and `more` at its end.
std::string quickHelix(const std::string& more = "") {
  return Program::shipped("paper-helix.toml") + "\n[simulation]\nsamples = 11\n" + more;
}

TEST(ValidateVerb, passesThePapersHelixAndLeavesAllResults) {
  const Program ursula;
  const UrsulaRun run = ursula("validate '" URSULA_SCENARIOS "/paper-helix.toml' --out dir");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("verdict: pass"));
  EXPECT_THAT(run.out, HasSubstr("report.html"));
  const auto dir = ursula.folder() / "dir";

  const auto summary = nlohmann::json::parse(TemporaryFolder::read(dir / "summary.json"));
  EXPECT_EQ(summary.at("scenario"), "paper-helix");
  EXPECT_EQ(summary.at("verdict"), "pass");
  EXPECT_GE(summary.at("checks").size(), 13u);
  int judged = 0;
  for (const auto& check : summary.at("checks")) {
    if (check.at("verdict") == "not_applicable") {
      EXPECT_NE(check.at("why"), "") << check;
      continue;
    }
    ++judged;
    EXPECT_EQ(check.at("verdict"), "pass") << check;
    EXPECT_LE(check.at("value").get<double>(), check.at("limit").get<double>()) << check;
    for (const char* key : {"name", "basis", "why"}) EXPECT_NE(check.at(key), "") << check;
    EXPECT_TRUE(check.at("unit").is_string());
  }
  EXPECT_GE(judged, 34);
  EXPECT_FALSE(summary.at("provenance").empty());

  const CsvTable series = readCsv(dir / "timeseries.csv");
  EXPECT_EQ(series.rows(), 301u);
  for (const char* column : {"t_s", "p_x_m", "tau_6_Nm", "sim_p_x_m", "error_p_m"})
    EXPECT_NE(series.find(column), nullptr) << column;
  EXPECT_THAT(TemporaryFolder::read(dir / "junit.xml"), HasSubstr("<testcase"));
  const std::string report = TemporaryFolder::read(dir / "report.html");
  EXPECT_THAT(report, HasSubstr("paper-helix"));
  const std::regex elsewhere("<(script|link|img)[^>]+(src|href) *= *['\"]?(https?:)?//");
  EXPECT_FALSE(std::regex_search(report, elsewhere)) << "it must work offline";
}

TEST(ValidateVerb, twoRunsWriteTheSameNumbersByDefaultToResultsByName) {
  const Program ursula;
  ursula.write("scenario.toml", quickHelix());
  ASSERT_EQ(ursula("validate scenario.toml").exit_code, 0);
  ASSERT_EQ(ursula("validate scenario.toml --out b").exit_code, 0);
  const auto a = ursula.folder() / "results" / "paper-helix", b = ursula.folder() / "b";
  for (const char* file : {"summary.json", "timeseries.csv"}) {
    EXPECT_NE(TemporaryFolder::read(a / file), "") << file;
    EXPECT_EQ(TemporaryFolder::read(a / file), TemporaryFolder::read(b / file)) << file;
  }
  for (const char* file : {"junit.xml", "report.html"}) EXPECT_TRUE(std::filesystem::is_regular_file(a / file)) << file;
}

TEST(ValidateVerb, exitsWithOneWhereACheckFailsAndStillReports) {
  const Program ursula;
  ursula.write("strict.toml", quickHelix("[acceptance]\n\"torque.pointwise\" = 1e-30\n"));
  const UrsulaRun run = ursula("validate strict.toml --out dir");
  EXPECT_EQ(run.exit_code, 1) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("verdict: fail"));
  EXPECT_THAT(run.out, HasSubstr("torque.pointwise"));
  const auto summary = nlohmann::json::parse(TemporaryFolder::read(ursula.folder() / "dir" / "summary.json"));
  EXPECT_EQ(summary.at("verdict"), "fail");
}

TEST(ValidateVerb, refusesWhatIsNoScenario) {
  const Program ursula;
  ursula.write("key.toml", replaced(good_scenario, "mass = 500.0", "mas = 500.0"));
  ursula.write("no_mass.toml", replaced(good_scenario, "mass = 500.0", "mass = -500.0"));
  ursula.write("no.toml", "name = [");
  ursula.write("far.toml", replaced(good_scenario, "height_phase = 2.2", "height_phase = 4.0"));
  expectRefused(ursula, {{"validate key.toml --out dir", "key.toml:5:1: error: unknown key 'mas'"},
                         {"validate key.toml --out dir", "did you mean 'mass'?"},
                         {"validate no_mass.toml --out dir", "no_mass.toml:5:8: error: "},
                         {"validate no.toml --out dir", "no.toml:1:"},
                         {"validate none.toml --out dir", "none.toml"},
                         {"validate far.toml --out dir", "is out of reach at t = "}});
}

}  // namespace
}  // namespace ursula
