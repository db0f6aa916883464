// `ursula validate` from the scenario, or a file of torques beside it, to the folder of results, by its exit codes.

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "base/csv.h"
#include "tests/end_to_end/program.h"
#include "tests/model/scenario_text.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

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

/// Makes a scenario and its results of `ursula inverse`.
void prepare(const Program& ursula, const std::string& samples) {
  ursula.write("small.toml", good_scenario);
  ursula.passing("inverse small.toml --samples " + samples + " --out tau.csv");
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
  const auto run = ursula("validate small.toml --torques tau.csv --out out --verbose");
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
  std::string text = ursula.read("tau.csv");
  text = replaced(text, "tau_2_Nm", "tau_x_Nm");
  text = replaced(text, "tau_5_Nm", "tau_2_Nm");
  ursula.write("tau.csv", replaced(text, "tau_x_Nm", "tau_5_Nm"));
  ursula.ending(1, "validate small.toml --torques tau.csv --out out");
  const std::string summary = ursula.read("out/summary.json");
  EXPECT_THAT(summary, HasSubstr("\"likely cause\": \"legs 2 and 5 swapped, which explains"));
}

TEST(TorquesRun, fewOnesAreInconclusive) {
  const Program ursula;
  prepare(ursula, "5");
  ursula.ending(3, "validate small.toml --torques tau.csv --out out");
}

TEST(TorquesRun, refusalsNameTheLineAndWriteNothing) {
  const Program ursula;
  prepare(ursula, "5");
  const std::string text = ursula.read("tau.csv");
  const auto refused = [&](const std::string& faulty) {
    ursula.write("bad.csv", faulty);
    const UrsulaRun run = ursula.ending(2, "validate small.toml --torques bad.csv --out out");
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
