// `ursula validate` from the scenario to the folder of results, by its exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "base/csv.h"
#include "tests/end_to_end/program.h"

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

/// Expects exit code 2, the message, and no file.
void expectRefused(const std::string& scenario, const std::string& message) {
  const Program ursula;
  ursula.write("bad.toml", scenario);
  const UrsulaRun run = ursula("validate bad.toml --out dir");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(std::regex_search(run.err, std::regex(message))) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(ursula.files(), 1u) << "nothing but the scenario";
}

TEST(ValidateVerb, refusesAMistypedKeyByItsPlaceAndTheNearest) {
  std::string text = Program::shipped("paper-helix.toml");
  const std::string key = "mass = 500.0";
  ASSERT_NE(text.find(key), std::string::npos);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(key)), '\n');
  expectRefused(text.replace(text.find(key), key.size(), "mas = 500.0"),
                "bad\\.toml:" + std::to_string(line) + ":1: error: .*mas.*did you mean.*mass");
}

TEST(ValidateVerb, refusesWhatNoMachineCanHave) {
  std::string text = Program::shipped("paper-helix.toml");
  const std::string key = "mass = 500.0";
  expectRefused(text.replace(text.find(key), key.size(), "mass = -500.0"), "bad\\.toml:[0-9]+:[0-9]+: error: .*-500");
}

TEST(ValidateVerb, refusesWhatIsNoToml) { expectRefused("name = [", "bad\\.toml:1:[0-9]+: error: "); }

TEST(ValidateVerb, refusesAFileThatIsNotThere) {
  const Program ursula;
  const UrsulaRun run = ursula("validate none.toml --out dir");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("none.toml"));
  EXPECT_EQ(ursula.files(), 0u);
}

TEST(ValidateVerb, refusesAMotionOutOfReach) {
  std::string text = Program::shipped("paper-helix.toml");
  const std::string key = "height_phase = 2.2";
  expectRefused(text.replace(text.find(key), key.size(), "height_phase = 4.0"), "leg [1-6]");
}

}  // namespace
}  // namespace ursula
