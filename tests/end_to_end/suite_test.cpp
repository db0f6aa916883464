// `ursula validate` on several scenarios, as a user calls it: exit codes, both output streams, and files.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/quick_runs.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::ContainsRegex;

std::string tooTight(const std::string& name) {
  return quickScenario(name) + "\n[acceptance]\n\"torque.pointwise\" = 1e-30\n";
}

/// Whether `path` exists below the run's folder.
bool isThere(const Program& ursula, const std::string& path) { return std::filesystem::exists(ursula.folder() / path); }

TEST(SuiteRun, aFolderThatPassesExitsWith0AndWritesEverything) {
  const Program ursula;
  std::filesystem::create_directory(ursula.folder() / "in");
  ursula.write("in/b.toml", quickScenario("second"));
  ursula.write("in/a.toml", quickScenario("first"));
  const UrsulaRun run = ursula.passing("validate in --jobs 2");
  EXPECT_THAT(run.out, AllOf(StartsWith("pass          first   "), HasSubstr("\npass          second  "),
                             HasSubstr("results/suite/first/report.html\n"),
                             EndsWith("2 passed, 0 failed, 0 inconclusive\nindex: results/suite/index.html\n")));
  // This is no terminal, so each scenario gets a line and there is no bar.
  EXPECT_THAT(run.err, AllOf(HasSubstr("[1/2] pass "), HasSubstr("[2/2] pass "), Not(HasSubstr("\r"))));
  for (const char* file : {"index.html", "junit.xml", "suite.json", "first/summary.json", "first/timeseries.csv",
                           "first/report.html", "first/junit.xml", "second/summary.json"})
    EXPECT_TRUE(isThere(ursula, std::string("results/suite/") + file)) << file;
}

TEST(SuiteRun, aFolderIsASuiteEvenOfOneScenario) {
  const Program ursula;
  std::filesystem::create_directory(ursula.folder() / "in");
  ursula.write("in/a.toml", quickScenario("alone"));
  const UrsulaRun run = ursula.passing("validate in");
  EXPECT_THAT(run.out, EndsWith("1 passed, 0 failed, 0 inconclusive\nindex: results/suite/index.html\n"));
  for (const char* file : {"index.html", "junit.xml", "suite.json", "alone/report.html"})
    EXPECT_TRUE(isThere(ursula, std::string("results/suite/") + file)) << file;
}

TEST(SuiteRun, oneThatFailsMakesTheExitCode1) {
  const Program ursula;
  ursula.write("good.toml", quickScenario("good"));
  ursula.write("tight.toml", tooTight("tight"));
  const UrsulaRun run = ursula.ending(1, "validate good.toml tight.toml --out out");
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("pass          good   "), HasSubstr("\nfail          tight  torque.pointwise is at "),
                    HasSubstr("1 passed, 1 failed, 0 inconclusive\n")));
  EXPECT_THAT(ursula.read("out/junit.xml"), HasSubstr("<failure "));
}

void writeOneGoodAndTwoBad(const Program& ursula) {
  ursula.write("good.toml", quickScenario("good"));
  ursula.write("reach.toml", replaced(quickScenario("reach"), "height_phase = 2.2", "height_phase = 5"));
  ursula.write("key.toml", replaced(quickScenario("key"), "mass = 500.0", "weight = 500.0"));
}

TEST(SuiteRun, oneBadScenarioIsItsOwnErrorAndNotTheEndOfTheSuite) {
  const Program ursula;
  writeOneGoodAndTwoBad(ursula);
  const UrsulaRun run = ursula.ending(1, "validate key.toml good.toml reach.toml --out out");
  EXPECT_THAT(run.out, AllOf(StartsWith("error         key.toml  key.toml:5:1: error: "),
                             HasSubstr("\npass          good      "), HasSubstr("\nerror         reach     "),
                             HasSubstr("1 passed, 0 failed, 0 inconclusive, 2 in error\n")));
  EXPECT_THAT(run.err, AllOf(StartsWith("key.toml:5:1: error: "), HasSubstr("] error key.toml, ")));
  EXPECT_TRUE(isThere(ursula, "out/good/summary.json"));
  EXPECT_FALSE(isThere(ursula, "out/reach"));
  for (const char* file : {"out/junit.xml", "out/index.html"})
    EXPECT_THAT(ursula.read(file),
                AllOf(HasSubstr("key.toml:5:1: error: "), HasSubstr("error: the motion cannot be made")))
        << file;
}

TEST(SuiteRun, strictlyOrWhereAllAreBadNothingIsWritten) {
  const Program ursula;
  writeOneGoodAndTwoBad(ursula);
  for (const char* call : {"validate good.toml reach.toml key.toml --strict --out out",
                           "validate good.toml reach.toml key.toml --strict --jobs 2 --out out",
                           "validate reach.toml key.toml --out out"}) {
    const UrsulaRun run = ursula.ending(2, call);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, AllOf(ContainsRegex("reach.toml:[0-9]+:1: error: the motion cannot be made"),
                               HasSubstr("key.toml:5:1: error: ")));
    EXPECT_FALSE(isThere(ursula, "out"));
  }
}

TEST(SuiteRun, asJsonIsAnArrayOfTheSummaries) {
  const Program ursula;
  writeOneGoodAndTwoBad(ursula);
  const UrsulaRun run = ursula("validate good.toml key.toml --json --out out");
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0], nlohmann::json::parse(ursula.read("out/good/summary.json")));
  EXPECT_EQ(json[1]["scenario"], "key.toml");
  EXPECT_EQ(json[1]["verdict"], "error");
  EXPECT_THAT(json[1]["error"].get<std::string>(), StartsWith("key.toml:5:1: error: "));
}

TEST(SuiteRun, quietlyIsALineForEachThatPasses) {
  const Program ursula;
  ursula.write("a.toml", quickScenario("first"));
  ursula.write("b.toml", tooTight("second"));
  const UrsulaRun run = ursula.ending(1, "validate a.toml b.toml --quiet --out out");
  EXPECT_THAT(run.out, AllOf(StartsWith("first: pass — "), HasSubstr("\nsecond: fail — 1 of ")));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2);
  EXPECT_EQ(run.err, "");
}

TEST(SuiteRun, badUsageExitsWith2AndWritesNothing) {
  const Program ursula;
  for (const char* file : {"a.toml", "b.toml"}) ursula.write(file, quickScenario("same"));
  ursula.write("c.toml", quickScenario("other"));
  ursula.write("file", "");
  std::filesystem::create_directory(ursula.folder() / "empty");
  expectRefused(ursula, {{"validate a.toml b.toml", "b.toml: error: name = 'same' is also that of a.toml"},
                         {"validate empty", "empty: error: no scenario in this folder"},
                         {"validate a.toml c.toml --jobs 0", "--jobs"},
                         {"validate a.toml c.toml --torques t.csv", "--torques: got 2 scenarios, expected one"},
                         {"validate a.toml c.toml --out file", "expected a folder"},
                         {"validate none.toml", "none.toml"},
                         {"validate", "scenario is required"}});
}

TEST(SuiteRun, helpSaysWhatASuiteDoes) {
  const Program ursula;
  const UrsulaRun run = ursula.passing("validate --help");
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("--jobs"), HasSubstr("Several scenarios:"), HasSubstr("Exit code: 1 if any failed")));
}

}  // namespace
}  // namespace ursula
