// Options beside the verdict for a person at a terminal: JSON, --quiet, standard input, explanations, the browser.

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "model/check_catalogue.h"
#include "tests/end_to_end/program.h"
#include "tests/model/quick_scenario.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

TEST(Terminal, tableListsEveryCheckAndSaysWhatFailed) {
  const Program ursula;
  ursula.write("a.toml", quickScenario() + "[acceptance]\n\"torque.pointwise\" = 1e-30\n");
  const UrsulaRun run = ursula.ending(1, "validate a.toml --out out --verbose");
  const std::string summary = ursula.read("out/summary.json");
  EXPECT_EQ(nlohmann::json::parse(summary).at("verdict"), "fail");
  for (const CheckRow& check : checkCatalogue()) EXPECT_THAT(run.out, HasSubstr(check.name));
  EXPECT_THAT(run.out,
              AllOf(StartsWith("small: fail\n"), HasSubstr("\nMotors: the formulations agree on the efforts\n"),
                    HasSubstr("\n  fail          torque.pointwise"), HasSubstr("\nnot applicable, since "),
                    HasSubstr("\nverdict: fail — 1 of "), Not(testing::ContainsRegex("[^a-z]nan[^a-z]")),
                    Not(HasSubstr("\033"))));
}

TEST(Terminal, jsonIsTheSummaryAndNothingElse) {
  const Program ursula;
  ursula.write("a.toml", quickScenario());
  const UrsulaRun run = ursula.passing("validate a.toml --json --out out");
  EXPECT_EQ(nlohmann::json::parse(run.out).at("verdict"), "pass");
  EXPECT_EQ(run.out, ursula.read("out/summary.json"));
  ursula.ending(2, "validate a.toml --json --quiet");
}

TEST(Terminal, quietIsTheVerdictsSentence) {
  const Program ursula;
  ursula.write("a.toml", quickScenario());
  const UrsulaRun run = ursula.passing("validate a.toml --quiet");
  EXPECT_THAT(run.out, StartsWith("small: pass — "));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(std::filesystem::exists(ursula.folder() / "results/small/report.html")) << "by default";
}

TEST(Terminal, aScenarioMayComeFromStandardInput) {
  const Program ursula;
  ursula.write("a.toml", quickScenario());
  ursula.write("bad.toml", replaced(quickScenario(), "mass = 500.0", "weight = 500.0"));
  EXPECT_EQ(ursula("inverse - --samples 3 <a.toml").out, ursula("inverse a.toml --samples 3").out);
  EXPECT_THAT(ursula("check - <a.toml").out,
              StartsWith("<stdin>: the scenario and its motion are valid; 0 warnings\n"));
  ursula.passing("validate - --quiet <a.toml");
  EXPECT_TRUE(std::filesystem::exists(ursula.folder() / "results/small/summary.json"));
  const UrsulaRun bad = ursula.ending(2, "validate - <bad.toml");
  EXPECT_THAT(bad.err, StartsWith("<stdin>:5:1: error: "));
  EXPECT_THAT(ursula("validate - - <a.toml").err, HasSubstr("standard input can be read once"));
  EXPECT_THAT(ursula("validate - --solver true <a.toml").err, HasSubstr("got - as the scenario, expected a file"));
}

TEST(Terminal, aFolderIsNotStandardOutput) {
  const Program ursula;
  ursula.write("a.toml", quickScenario());
  const UrsulaRun run = ursula.ending(2, "validate a.toml --out -");
  EXPECT_THAT(run.err, HasSubstr("--out -: expected a folder"));
  EXPECT_EQ(ursula.files(), 1u);
}

TEST(Explain, hasAPageForEachCheckAndAListOfAll) {
  const Program ursula;
  const UrsulaRun all = ursula.passing("explain");
  EXPECT_THAT(all.out, HasSubstr("Kinematics: solver and Simbody agree\n"));
  for (const CheckRow& check : checkCatalogue()) {
    EXPECT_THAT(all.out, HasSubstr(std::string("\n  ") + check.name + " "));
    const UrsulaRun page = ursula.passing(std::string("explain ") + check.name);
    EXPECT_THAT(page.out, AllOf(StartsWith(std::string(check.name) + ": "), HasSubstr("\nproves "),
                                HasSubstr("\nlimit "), HasSubstr("\nif it fails ")));
  }
}

/// The browser's stand-in writes its arguments and runs until the test's folder is gone.
TEST(Open, startsTheBrowserWithTheReportAndDoesNotWait) {
  const Program ursula;
  ursula.write("browser",
               "#!/bin/sh\necho \"$1\" > shown.part && mv shown.part shown\nwhile [ -e shown ]; do sleep 0.1; done\n");
  std::filesystem::permissions(ursula.folder() / "browser", std::filesystem::perms::owner_all);
  std::filesystem::create_directory(ursula.folder() / "out");
  ursula.write("out/index.html", "");
  ::setenv("BROWSER", (ursula.folder() / "browser").c_str(), 1);
  const UrsulaRun run = ursula("open out");
  ::unsetenv("BROWSER");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, (ursula.folder() / "out/index.html").string() + "\n");
  const auto shown = [&ursula] { return std::filesystem::exists(ursula.folder() / "shown"); };
  for (int k = 0; k < 12000 && !shown(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(shown());
  EXPECT_EQ(ursula.read("shown"), run.out);
}

/// $BROWSER is read as other programs read it: each %s is the page as one word, even within quotes.
TEST(Open, takesTheBrowserAsItIsQuoted) {
  const Program ursula;
  const std::filesystem::path folder = ursula.folder() / "a  b's $HOME";
  std::filesystem::create_directory(folder);
  ursula.write("a  b's $HOME/report.html", "");
  ursula.write("browser", "#!/bin/sh\nprintf '<%s>' \"$@\" > shown.part && mv shown.part shown\n");
  std::filesystem::permissions(ursula.folder() / "browser", std::filesystem::perms::owner_all);
  const std::string page = (folder / "report.html").string();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"./browser", "<" + page + ">"},
      {"./browser %s", "<" + page + ">"},
      {"./browser \"%s\"", "<" + page + ">"},
      {"./browser '%s'", "<" + page + ">"},
      {"./browser '--page=%s' \"at \\\" %s\" %s", "<--page=" + page + "><at \" " + page + "><" + page + ">"},
      {"./browser --page=%s%s", "<--page=" + page + page + ">"}};
  for (const auto& [browser, expected] : cases) {
    ::setenv("BROWSER", browser.c_str(), 1);
    EXPECT_EQ(ursula("open \"a  b's \\$HOME\"").exit_code, 0) << browser;
    ::unsetenv("BROWSER");
    const std::filesystem::path shown = ursula.folder() / "shown";
    for (int k = 0; k < 12000 && !std::filesystem::exists(shown); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(TemporaryFolder::read(shown), expected) << browser;
    std::filesystem::remove(shown);
  }
}

TEST(Open, saysWhereThereIsNoReportOrNoBrowser) {
  const Program ursula;
  std::filesystem::create_directory(ursula.folder() / "out");
  const UrsulaRun none = ursula.ending(2, "open out");
  EXPECT_THAT(none.err, HasSubstr("out has neither report.html nor index.html"));
  ursula.write("out/report.html", "");
  ::unsetenv("BROWSER");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const UrsulaRun alone = ursula("open out");
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.out, HasSubstr("out/report.html\n"));
  EXPECT_THAT(alone.err, HasSubstr("neither $BROWSER nor xdg-open is there"));
}

}  // namespace
}  // namespace ursula
