// Suites: their files, and refusals before anything is computed. tests/end_to_end/ has whole runs.

#include "apps/suite/suite.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "tests/base/temporary_folder.h"
#include "tests/model/quick_scenario.h"
#include "tests/model/refusals.h"
#include "tests/support/matchers.h"

namespace ursula {
namespace {

using testing::ContainsRegex;

std::vector<SuiteMember> threeScenarios(const TemporaryFolder& folder) {
  return readSuite({folder.write("a.toml", quickScenario("first")), folder.write("b.toml", quickScenario("second")),
                    folder.write("c.toml", quickScenario("third"))});
}

ValidationResult passing(const Scenario& scenario) {
  ValidationResult result;
  result.scenario = scenario.name;
  result.checks = {judged("check", 1, 2, "m", "basis", "why")};
  result.verdict = overall(result.checks);
  result.timeseries.add("t_s", {0, 1});
  return result;
}

SuiteOptions options(int jobs, std::function<ValidationResult(const Scenario&)> judge) {
  SuiteOptions out;
  out.jobs = jobs;
  out.judge = [judge = std::move(judge)](const SuiteMember& member) { return judge(*member.scenario); };
  return out;
}

TEST(Suite, severalAreJudgedAtATimeAndEntriesKeepTheirOrder) {
  const TemporaryFolder folder;
  std::atomic<int> waiting{0};
  SuiteOptions two = options(2, [&waiting](const Scenario& scenario) {
    ++waiting;
    // The first waits until another has begun, so with one thread this would never end.
    while (scenario.name == "first" && waiting < 2) std::this_thread::yield();
    return passing(scenario);
  });
  std::vector<std::size_t> done;
  two.finished = [&done](const SuiteEntry&, std::size_t count) { done.push_back(count); };
  const auto entries = runSuite(threeScenarios(folder), folder.path() / "out", two);
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].scenario, "first");
  EXPECT_EQ(entries[1].scenario, "second");
  EXPECT_EQ(entries[2].scenario, "third");
  EXPECT_THAT(done, ElementsAre(1u, 2u, 3u));
}

TEST(Suite, aScenarioWhoseJudgeThrowsFailsWithTheReasonAndTheOthersGoOn) {
  const TemporaryFolder folder;
  const std::filesystem::path dir = folder.path() / "out";
  const auto throwing = [](const Scenario& scenario) -> ValidationResult {
    if (scenario.name == "second") throw std::runtime_error("no such luck");
    return passing(scenario);
  };
  runSuite(threeScenarios(folder), dir, options(1, passing));
  const auto entries = runSuite(threeScenarios(folder), dir, options(2, throwing));
  EXPECT_EQ(entries[0].verdict, Verdict::pass);
  EXPECT_EQ(entries[1].verdict, Verdict::fail);
  EXPECT_EQ(entries[1].error, "no such luck");
  EXPECT_EQ(entries[2].verdict, Verdict::pass);
  EXPECT_THAT(TemporaryFolder::read(dir / "junit.xml"), HasSubstr("message=\"no such luck\""));
  EXPECT_FALSE(std::filesystem::exists(dir / "second" / "summary.json")) << "that of the run before has to go";
}

TEST(Suite, whatCannotBeWrittenIsNoVerdict) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("out", "a file where a folder should be");
  for (const int jobs : {1, 2})
    EXPECT_ANY_THROW(runSuite(threeScenarios(folder), file, options(jobs, passing))) << jobs;
}

TEST(Suite, fewerThanOneJobIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal<std::invalid_argument>([&] { runSuite({}, folder.path(), options(0, passing)); }),
              HasSubstr("0 jobs"));
}

TEST(SuiteInput, aFolderStandsForItsTomlFilesSorted) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "in" / "below");
  std::filesystem::create_directories(folder.path() / "in" / "e.toml");
  folder.write("in/b.toml", quickScenario("second"));
  folder.write("in/a.toml", quickScenario("third"));
  folder.write("in/c.csv", "no scenario");
  folder.write("in/below/d.toml", "none either");
  const auto first = folder.write("z.toml", quickScenario("first"));
  std::vector<std::string> read;
  for (const SuiteMember& member : readSuite({first, folder.path() / "in"})) read.push_back(member.name);
  EXPECT_THAT(read, ElementsAre("first", "third", "second"));
}

/// The motion passes a singular pose, turned by about 45.26° about e_z, between two instants.
TEST(SuiteInput, aMotionThroughASingularPoseIsRefusedThoughNoInstantMeetsIt) {
  const TemporaryFolder folder;
  std::string text = quickScenario("singular");
  text.erase(text.find("[trajectory]"));
  const std::string poses = R"([trajectory]
kind = "waypoints"
points = [
  { time = 0.0, position = [0.0, 0.0, 1.2], orientation = [1.0, 0.0, 0.0, 0.0] },
  { time = 2.0, position = [0.0, 0.0, 1.2], orientation = [SECOND] },
]
)";
  const auto turned = [&](const std::string& q) { return folder.write("t.toml", text + replaced(poses, "SECOND", q)); };
  EXPECT_THAT(refusal<ScenarioError>([&] { allOrNothing(readSuite({turned("0.9063, 0.0, 0.0, 0.4226")})); }),  // 50°
              ContainsRegex("t.toml:[0-9]+:1: error: the motion cannot be made: at t = .* s the pose is singular"));
  EXPECT_EQ(readSuite({turned("0.9397, 0.0, 0.0, 0.3420")}).front().error, "");  // 40°
}

TEST(SuiteInput, scenariosOfOneNameAreRefusedNamingBothFiles) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.toml", quickScenario("same")),
             b = folder.write("b.toml", quickScenario("same", "499.0"));
  EXPECT_EQ(refusal<ScenarioError>([&] {
              readSuite({a, b});
            }),
            b.string() + ": error: name = 'same' is also that of " + a.string() + ", expected a name for each");
  EXPECT_THAT(refusal<ScenarioError>([&] { readSuite({a, a}); }), HasSubstr("'same' is also that of"));
}

TEST(SuiteInput, aNameThatASuitesOwnFilesHaveIsRefusedInASuite) {
  const TemporaryFolder folder;
  const auto a = folder.write("a.toml", quickScenario("index.html")), b = folder.write("b.toml", quickScenario("b"));
  EXPECT_THAT(refusal<ScenarioError>([&] {
                readSuite({a, b});
              }),
              HasSubstr("'index.html' is also that of the suite's"));
  EXPECT_EQ(readSuite({a}).size(), 1u);
}

}  // namespace
}  // namespace ursula
